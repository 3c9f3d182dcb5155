// What came of one case.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "audit/method.h"
#include "audit/scene.h"

namespace plumb::audit::soundness {

enum class Ending {
  Held,
  Broken,   // a claim of the frame or of a patch
  None,     // nothing was measured, for a stated reason
  Refused,  // an error of one line, as bad input ends in
  Failed,   // any other exception
};
inline constexpr int kEndings = 5;
const char* name_of(Ending ending);  // "held", "broken", "none", "refused", "failed"

struct Outcome {
  Ending ending = Ending::Failed;
  std::string reason;               // the verdict's sentence, or the error's line
  int claims = 0;                   // of the frame that were measured
  std::int64_t patch_claims = 0;    // of patches
  std::int64_t pixels_seen = 0;     // of the truth
  std::optional<double> tightness;  // of the tightest claim that measured more than zero
  bool promises_nothing = false;    // every bound but coverage's is infinite

  friend bool operator==(const Outcome&, const Outcome&) = default;
};

/// Audits a scene as `plumb audit` does: the same truth, frame, band and claims.
///
///   (1) The same on every machine and number of threads.
Outcome outcome_of(const MethodTable& table, const Scene& scene);

/// A refusal that the documentation states: why it is one, or an empty text.
std::string stated_refusal(const Outcome& outcome);

/// Held, without a verdict for a stated reason, or refused as stated.
bool is_sound(const Outcome& outcome);

}  // namespace plumb::audit::soundness
