// Draws a scene, audits it, and says whether what is measured is what was stated.
#pragma once

#include <optional>
#include <string>

#include "audit/stability/failure_scene.h"
#include "core/claim.h"
#include "core/cost.h"
#include "image/colour_image.h"

namespace plumb::audit::stability {

/// One variant of one method in a scene.
struct VariantRun {
  std::string refused = {};  // the one line why; empty: it was drawn
  Verdict verdict = Verdict::None;
  std::string sentence = {};             // the verdict in words
  std::string broken_by = {};            // if not by the expected reading: what broke, and how far
  double measured = 0.0;                 // the expected reading
  std::optional<double> claimed = {};    // what is claimed of it; nothing: no claim speaks of it
  std::int64_t patch_claims_broken = 0;  // that the audit found
  bool has_nan = false;                  // a figure of the audit is no number
  bool is_as_expected = false;
  Cost cost;
  /// If asked for; empty if refused. Of readings that count triangles, these are drawn outlined;
  /// the error is on screen, vertical (of stacks: to the nearest point), but for colours.
  image::Rgb8Image drawn = {}, error = {};
};

struct SceneRun {
  const Scene* scene = nullptr;
  std::string method;
  std::optional<Expected> expected_published, expected_conservative;
  std::optional<VariantRun> published, conservative;

  bool is_as_expected() const {
    return (!published || published->is_as_expected) &&
           (!conservative || conservative->is_as_expected);
  }
};

/// Where the scale of a picture of errors ends: at the tolerance, or at a pixel where that is in
/// metres.
double error_scale_px(const Tolerance& tolerance);

/// Both variants, as far as the scene expects something of them and the method has them.
///
/// method         one of the scene's
/// with_pictures  draws what a page shows
///   (1) The same bits on any number of threads.
/// Throws InputError for a method that is not in the table.
SceneRun run_scene(const Scene& scene, const std::string& method, bool with_pictures = false);

}  // namespace plumb::audit::stability
