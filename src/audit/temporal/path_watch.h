// Watches the frames of a path go by.
#pragma once

#include <optional>
#include <utility>

#include "audit/temporal/frame_change.h"

namespace plumb::audit::temporal {

/// Keeps the last two frames of a path, and tells of each new one what changed.
class PathWatch {
 public:
  /// Keeps references to what `truth` is made of.
  explicit PathWatch(const TruthTerms& truth, const ChangeOptions& options = {})
      : truth_(truth), options_(options) {}

  /// The next frame, in the order of the path.
  ///
  /// surface  what was drawn for `camera`; its mesh is shared, its patches and levels are copied
  /// audited  its audit
  FrameChange next(const DrawnSurface& surface, const Camera& camera, const AuditResult& audited) {
    Frame now(surface, camera);
    FrameChange change = change_between(truth_, audited, now, before_ ? &*before_ : nullptr,
                                        earlier_ ? &*earlier_ : nullptr, options_);
    earlier_ = std::move(before_);
    before_ = std::move(now);
    return change;
  }

 private:
  TruthTerms truth_;
  ChangeOptions options_;
  std::optional<Frame> before_, earlier_;
};

}  // namespace plumb::audit::temporal
