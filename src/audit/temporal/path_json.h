// The frames of a path as JSON.
#pragma once

#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/audit_subject.h"
#include "audit/temporal/frame_change.h"

namespace plumb::audit::temporal {

/// audit_json of a frame with two members more, `popping` and `flicker`, each null where it is not
/// measured. Documented in docs/cameras.md.
std::string frame_json(const AuditResult& audited, const AuditSubject& subject,
                       const FrameChange& change);

/// One JSON object, schema "plumb.audit-path/1", ending in a line feed, of what frame_json gave for
/// the frames of a path, in their order.
std::string path_json(const std::vector<std::string>& frames);

/// {"max_px", "p99_px", "pixels_over_1px", "flicker_pixels"} on one line without a line feed: the
/// member `popping` of a sweep's line; "null" on a path's first frame. `flicker_pixels` is null
/// where no flicker is measured.
std::string popping_summary_json(const FrameChange& change);

}  // namespace plumb::audit::temporal
