#include "audit/stability/run_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "audit/audit_pictures.h"
#include "audit/mesh_truth.h"
#include "audit/method.h"
#include "audit/solid_audit.h"
#include "audit/stability/reading.h"
#include "audit/truth_terms.h"
#include "audit/verdict_text.h"
#include "core/check.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::audit::stability {

double error_scale_px(const Tolerance& tolerance) {
  return tolerance.unit == Unit::Pixel ? tolerance.value : 1.0;
}

namespace {

// The truth of either kind of terrain.
class Truth {
 public:
  Truth(const terrain::Heightfield& field, const Method& method, const MethodChoice& choice) {
    if (field.stacks == nullptr) {
      heights_.emplace(field, method.truth);
    } else {
      mesh_.emplace(field, full_detail_of_stacks(built_in_methods(), field, &method, choice));
    }
  }
  AuditResult audit(const DrawnSurface& surface, const Camera& camera,
                    const AuditOptions& options) const {
    return mesh_ ? audit_surface(*mesh_, surface, camera, options)
                 : audit_surface(*heights_, surface, camera, options);
  }
  TruthTerms terms() const { return mesh_ ? TruthTerms(*mesh_) : TruthTerms(*heights_); }

 private:
  std::optional<HeightfieldTruth> heights_;
  std::optional<MeshTruth> mesh_;
};

bool takes_a_size(const Method& method, const std::string& variant) {
  const std::vector<std::string>& variants = method.size_variants;
  return std::find(variants.begin(), variants.end(), variant) != variants.end();
}

AuditOptions options_of(const Scene& scene, const Method& method, const std::string& variant) {
  AuditOptions options;
  if (takes_a_size(method, variant)) return options;
  (scene.tolerance.unit == Unit::Pixel ? options.band.pixels : options.band.metres) =
      scene.tolerance.value;
  return options;
}

// What broke where the claim of this reading did not; empty if it did, or nothing did.
std::string broken_by_another(const AuditResult& result, Reading reading) {
  std::string broken;
  for (const ClaimResult& claim : result.claims) {
    if (claim.claim.scope != Scope::Frame || !claim.is_broken()) continue;
    if (claim.label == name_of(reading)) return "";
    if (broken.empty())
      broken = fmt::format("{} {}", claim.label, with_unit(claim.measured, claim.claim.unit));
  }
  if (broken.empty() && result.patch_claims_broken > 0)
    broken = fmt::format("patch-claims {}", result.patch_claims_broken);
  return broken;
}

bool has_nan(const AuditResult& result) {
  const auto bad = [](const Distribution& d) {
    return std::isnan(d.max) || std::isnan(d.max_finite) || std::isnan(d.rms) ||
           std::isnan(d.p50) || std::isnan(d.p999);
  };
  for (const Distribution* d :
       {&result.samples.metres, &result.samples.pixels, &result.vertical, &result.reverse_vertical,
        &result.depth, &result.normal_deg, &result.nearest.forward, &result.nearest.reverse})
    if (bad(*d)) return true;
  return std::any_of(result.claims.begin(), result.claims.end(), [](const ClaimResult& claim) {
    return std::isnan(claim.measured) || std::isnan(claim.claim.bound);
  });
}

std::optional<double> claimed_of(Reading reading, const Scene& scene, const AuditResult& result) {
  for (const ClaimResult& each : result.claims) {
    if (each.claim.scope == Scope::Frame && each.label == name_of(reading) &&
        each.claim.unit == unit_of(reading, scene.tolerance.unit))
      return each.claim.bound;
  }
  return {};
}

const std::vector<float>& errors_of(const AuditResult& result) {
  return result.of_heights ? result.pixels.vertical_px : result.nearest.forward_px;
}

// Errors, and defects of coverage over them.
image::Rgb8Image error_picture(const AuditResult& result, double scale_px) {
  image::Rgb8Image picture = error_map(result, errors_of(result), "", scale_px).picture;
  const image::Rgb8Image defects = coverage_picture(result);
  for (std::size_t k = 0; k < result.coverage.defects.size(); ++k) {
    if (result.coverage.defects[k] == DefectKind::None) continue;
    const auto width = static_cast<std::size_t>(picture.width_px);
    paint(picture, static_cast<int>(k % width), static_cast<int>(k / width),
          {defects.rgb[3 * k], defects.rgb[3 * k + 1], defects.rgb[3 * k + 2]});
  }
  return picture;
}

// Whether how the surface is cut into triangles says more than how it looks.
bool is_of_triangles(Reading reading) {
  return reading == Reading::TJunctions || reading == Reading::LevelJump ||
         reading == Reading::Triangles;
}

bool meets(const VariantRun& run, const Expected& expected) {
  if (!expected.refusal.empty()) return run.refused.find(expected.refusal) != std::string::npos;
  return run.refused.empty() && !run.has_nan &&
         (!expected.verdict || run.verdict == *expected.verdict) &&
         run.measured >= expected.least && run.measured <= expected.most;
}

class Stage {
 public:
  Stage(const Scene& scene, const Method& method, bool with_pictures)
      : scene_(scene), method_(method), with_pictures_(with_pictures) {}

  VariantRun run(const std::string& variant, const Expected& expected) const {
    VariantRun run;
    try {
      draw(variant, expected, run);
    } catch (const InputError& error) {
      run.refused = error.what();
    } catch (const std::invalid_argument& error) {  // the command prints both as one line
      run.refused = error.what();
    }
    run.is_as_expected = meets(run, expected);
    return run;
  }

 private:
  void draw(const std::string& variant, const Expected& expected, VariantRun& run) const {
    const terrain::Heightfield field = scene_.terrain();
    terrain::require_valid(field);
    const Camera camera = make_camera(scene_.camera);
    const MethodChoice choice =
        resolved_choice(method_, {is_printed(variant) ? "" : variant, parameters_of(variant)});
    require_drawable(method_, field);
    const DrawnSurface surface = is_printed(variant) ? scene_.as_printed(field, scene_.tolerance)
                                                     : last_frame(field, choice, camera);
    const Truth truth(field, method_, choice);
    const AuditResult result = truth.audit(surface, camera, options_of(scene_, method_, variant));
    run.verdict = result.verdict();
    run.sentence = verdict_sentence(result);
    run.broken_by = broken_by_another(result, expected.reading);
    run.measured =
        value_of(expected.reading, scene_.tolerance.unit, truth.terms(), surface, result, camera);
    run.claimed = claimed_of(expected.reading, scene_, result);
    run.patch_claims_broken = result.patch_claims_broken;
    run.has_nan = has_nan(result) || std::isnan(run.measured);
    run.cost = result.cost;
    if (!with_pictures_) return;
    show(expected.reading, result, truth.terms(), surface, camera, run);
  }

  void show(Reading reading, const AuditResult& result, const TruthTerms& truth,
            const DrawnSurface& surface, const Camera& camera, VariantRun& run) const {
    const image::Rgb8Image drawn = drawn_picture(result, truth, surface, camera);
    run.drawn = is_of_triangles(reading) ? triangles_picture(result, surface) : drawn;
    run.error = reading == Reading::ColourError
                    ? difference_picture(truth_picture(result, truth, camera), drawn)
                    : error_picture(result, error_scale_px(scene_.tolerance));
  }

  bool is_printed(const std::string& variant) const {
    return variant == "published" && scene_.as_printed;
  }

  DrawnSurface last_frame(const terrain::Heightfield& field, const MethodChoice& choice,
                          const Camera& camera) const {
    const Tolerance tolerance = takes_a_size(method_, choice.variant)
                                    ? scene_.size.value_or(scene_.tolerance)
                                    : scene_.tolerance;
    const auto prepared = prepare_method(method_, field, choice, tolerance);
    const auto frames = prepared->start();
    for (const LookAt& before : scene_.before) frames->step(make_camera(before), tolerance);
    return frames->step(camera, tolerance);
  }

  // Those of the published variant alone would be refused by the other.
  std::map<std::string, std::string> parameters_of(const std::string& variant) const {
    std::map<std::string, std::string> parameters = scene_.parameters;
    if (variant != "published") parameters.erase("mend");
    return parameters;
  }

  const Scene& scene_;
  const Method& method_;
  bool with_pictures_;
};

}  // namespace

SceneRun run_scene(const Scene& scene, const std::string& method, bool with_pictures) {
  const Method& row = find_method(built_in_methods(), method);
  const Stage stage(scene, row, with_pictures);
  SceneRun run{&scene, method, scene.published, scene.conservative, {}, {}};
  const auto special = scene.otherwise.find(method);
  if (special != scene.otherwise.end())
    run.expected_published = run.expected_conservative = special->second;
  const auto has = [&](const char* variant) {
    return std::find(row.variants.begin(), row.variants.end(), variant) != row.variants.end();
  };
  if (!has("published") && !scene.as_printed) run.expected_published.reset();
  if (run.expected_published) run.published = stage.run("published", *run.expected_published);
  if (run.expected_conservative)
    run.conservative = stage.run("conservative", *run.expected_conservative);
  return run;
}

}  // namespace plumb::audit::stability
