#include "compare/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "compare/alignment.h"
#include "compare/value_models.h"
#include "core/parallel.h"
#include "image/camera_metadata.h"
#include "image/srgb.h"

namespace plumb::compare {
namespace {

using image::Plane;
using image::PlaneImage;

// What is left of a difference that is named.
constexpr double kMostLeft = 0.5;
// A jitter of a tenth of a pixel, that two samplers may have, is no shift; of a picture of few
// outlines it was found as up to a third of one in 300 scenes.
constexpr double kLeastShift_px = 0.4;
// A picture sampled at points, moved by half a pixel, keeps most of its difference: at an outline a
// pixel is on one side or the other. But it is explained pixel by pixel, but for a quarter of one
// more, where a level of detail whose best shift is as long is not. Measured on four generated
// terrains in three views with one and four rays a pixel: moved by half a pixel or more, 0 to 0.53
// of the unexplained pixels are left (docs/comparing.md); of a level of detail, 0.90 and more.
constexpr double kMostLeftOfShift = 0.925;
constexpr double kMostLeftOfJitter = 0.96;
constexpr double kMostUnexplained = 0.7;
constexpr double kFewUnexplained = 0.0005;  // of all pixels: too few to judge a shift by
// Then, in 300 scenes: jitter leaves 0.72 and more of what the best jitter leaves, half a pixel
// 0.58.
constexpr double kMostLeftOfSmooth = 0.65;

enum class Subject { Values, Places, Depth };

Subject subject_of(Systematic kind) {
  switch (kind) {
    case Systematic::FlippedY:
    case Systematic::FlippedX:
    case Systematic::Shift:
    case Systematic::FieldOfViewAxis:
      return Subject::Places;
    case Systematic::DepthScale:
    case Systematic::WindowDepth:
    case Systematic::DistanceAsDepth:
      return Subject::Depth;
    default:
      return Subject::Values;
  }
}

class Findings {
 public:
  void offer(Systematic kind, double before, double after, std::string text,
             double most_left = kMostLeft) {
    if (before > 0.0 && after <= most_left * before)
      found_.push_back({kind, std::move(text), before, after});
  }
  // The same of a model of numbers. A picture without structure is like anything times little: what
  // is left must be small beside the candidate's own deviation from its mean as well.
  void offer_model(Systematic kind, double before, double after, double deviation,
                   std::string text) {
    constexpr double kRounding = 0.5 / 255.0;
    if (after <= kMostLeft * deviation || after <= kRounding)
      offer(kind, before, after, std::move(text));
  }
  std::vector<Diagnosis> sorted() {
    std::stable_sort(found_.begin(), found_.end(), [](const Diagnosis& a, const Diagnosis& b) {
      return a.rms_after / a.rms_before < b.rms_after / b.rms_before;
    });
    // What explains most of its kind is named; the others explain the same, less well.
    std::vector<Diagnosis> best;
    for (Diagnosis& each : found_) {
      const bool rival = std::any_of(best.begin(), best.end(), [&](const Diagnosis& better) {
        return subject_of(better.kind) == subject_of(each.kind);
      });
      if (!rival) best.push_back(std::move(each));
    }
    return best;
  }

 private:
  std::vector<Diagnosis> found_;
};

std::vector<PlanePair> colour_pairs(const PlaneImage& reference, const PlaneImage& candidate) {
  std::vector<PlanePair> pairs;
  for (const char* name : {"R", "G", "B", "Y"}) {
    const Plane *a = reference.find(name), *b = candidate.find(name);
    if (a != nullptr && b != nullptr) pairs.push_back({a->values, b->values});
  }
  return pairs;
}

// Root mean square deviation of the candidate's numbers from a mean.
double deviation_of(const std::vector<PlanePair>& pairs, double mean) {
  std::vector<PlanePair> of_itself;
  for (const PlanePair& pair : pairs) of_itself.push_back({pair.candidate, pair.candidate});
  return rms_of(of_itself, [&](double) { return mean; });
}

// Tries models of a candidate's numbers on a few pixels first, since most pairs have none.
class ModelTrial {
 public:
  ModelTrial(const std::vector<PlanePair>& pairs, double mean_of_candidate, Findings& findings)
      : pairs_(pairs),
        findings_(findings),
        before_(rms_of(pairs, kSame)),
        before_of_few_(rms_of(pairs, kSame, kFew)),
        deviation_(deviation_of(pairs, mean_of_candidate)) {}

  template <class Model>
  void offer(Systematic kind, const Model& model, const std::string& text) {
    // Half as much again as a finding may leave: a few thousand numbers are nearer to all than
    // that.
    if (rms_of(pairs_, model, kFew) > 1.5 * kMostLeft * before_of_few_) return;
    findings_.offer_model(kind, before_, rms_of(pairs_, model), deviation_, text);
  }

 private:
  static constexpr std::int64_t kFew = 61;  // every so manieth pixel; prime, so no column's
  static constexpr auto kSame = [](double x) { return x; };

  const std::vector<PlanePair>& pairs_;
  Findings& findings_;
  double before_, before_of_few_, deviation_;
};

void look_at_values(const std::vector<PlanePair>& pairs, Findings& findings) {
  const LineFit fit = fit_line(pairs);
  const double offset = fit.mean_candidate - fit.mean_reference;
  const auto clamped = [](double x) { return std::clamp(x, 0.0, 1.0); };
  ModelTrial trial(pairs, fit.mean_candidate, findings);
  trial.offer(
      Systematic::Offset, [&](double x) { return x + offset; },
      fmt::format("the candidate is the reference plus {:.4g}", offset));
  trial.offer(
      Systematic::Gain, [&](double x) { return fit.gain * x; },
      fmt::format("the candidate is the reference times {:.4g}", fit.gain));
  trial.offer(
      Systematic::LinearAsSrgb, [&](double x) { return image::srgb_to_linear(clamped(x)); },
      "the candidate holds linear light where the reference holds sRGB: it was not encoded");
  trial.offer(
      Systematic::SrgbAsLinear, [&](double x) { return linear_to_srgb(clamped(x)); },
      "the candidate holds sRGB where the reference holds linear light: it was encoded twice, or "
      "should not have been");
  if (const std::optional<double> power = fit_power(pairs)) {
    trial.offer(
        Systematic::Gamma, [&](double x) { return power_of(clamped(x), *power); },
        fmt::format("the candidate is the reference to the power of {:.4g}", *power));
  }
}

Grid<float> flipped(const Grid<float>& picture, bool rows) {
  Grid<float> result(picture.columns(), picture.rows());
  parallel_for(picture.rows(), 16, [&](std::int64_t at) {
    const int j = static_cast<int>(at);
    const std::span<const float> from = picture.row(rows ? picture.rows() - 1 - j : j);
    if (rows) {
      std::copy(from.begin(), from.end(), result.row(j).begin());
    } else {
      std::reverse_copy(from.begin(), from.end(), result.row(j).begin());
    }
  });
  return result;
}

double rms_between(const Grid<float>& a, const Grid<float>& b) {
  return rms_of({PlanePair{a.values(), b.values()}}, [](double x) { return x; });
}

bool is_farthest(const glm::dvec2& by_px) {
  return std::max(std::abs(by_px.x), std::abs(by_px.y)) > kFarthestShift_px - 0.5;
}

// A shift that is more than jitter, and explains the difference.
std::optional<Shift> true_shift(const Grid<float>& reference, const Grid<float>& candidate) {
  const Shift shift = find_shift(reference, candidate);
  if (std::max(std::abs(shift.by_px.x), std::abs(shift.by_px.y)) < kLeastShift_px ||
      shift.rms_after > kMostLeftOfShift * shift.rms_before ||
      shift.rms_after > kMostLeftOfJitter * shift.rms_of_jitter)
    return std::nullopt;
  const Unexplained share = unexplained_by(reference, candidate, shift.by_px);
  if (share.before <= kFewUnexplained) {
    // Nothing but smooth ground and a few outlines: the shift must do far better than jitter.
    if (shift.rms_after > kMostLeftOfSmooth * shift.rms_of_jitter) return std::nullopt;
  } else if (share.after > kMostUnexplained * share.before) {
    return std::nullopt;
  }
  return shift;
}

void look_at_places(const Grid<float>& reference, const Grid<float>& candidate,
                    Findings& findings) {
  const double before = rms_between(reference, candidate);
  if (!(before > 0.0)) return;
  findings.offer(Systematic::FlippedY, before, rms_between(flipped(reference, true), candidate),
                 "the candidate is the reference upside down");
  findings.offer(Systematic::FlippedX, before, rms_between(flipped(reference, false), candidate),
                 "the candidate is the reference with left and right changed");
  if (const auto shift = true_shift(reference, candidate)) {
    findings.offer(
        Systematic::Shift, shift->rms_before, shift->rms_after,
        fmt::format("the candidate is the reference shifted by ({:.2f}, {:.2f}) px, to "
                    "the right and down{}",
                    shift->by_px.x, shift->by_px.y,
                    is_farthest(shift->by_px) ? ", or by more: no farther was looked" : ""),
        kMostLeftOfShift);
  }
  const double aspect = static_cast<double>(reference.columns()) / reference.rows();
  if (std::abs(aspect - 1.0) < 0.01) return;
  const double as_they_are = rms_enlarged(reference, candidate, 1.0);
  for (const double factor : {aspect, 1.0 / aspect}) {
    findings.offer(
        Systematic::FieldOfViewAxis, as_they_are, rms_enlarged(reference, candidate, factor),
        fmt::format(
            "the candidate is the reference {} {:.4g} times around its middle: its angle of "
            "view was taken for the other axis",
            factor > 1.0 ? "enlarged" : "made smaller", factor > 1.0 ? factor : 1.0 / factor));
  }
}

// Length of the ray of view depth one through each pixel.
std::vector<float> ray_lengths(const Camera& camera) {
  std::vector<float> lengths(static_cast<std::size_t>(camera.width_px) * camera.height_px);
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const glm::dvec3 d = ray_direction(camera, x + 0.5, y + 0.5);
      lengths[static_cast<std::size_t>(y) * camera.width_px + static_cast<std::size_t>(x)] =
          static_cast<float>(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z));
    }
  }
  return lengths;
}

void look_at_depth(const PlaneImage& reference, const PlaneImage& candidate, Findings& findings) {
  const Plane *a = reference.find("Z"), *b = candidate.find("Z");
  if (a == nullptr || b == nullptr) return;
  const std::vector<PlanePair> pairs{{a->values, b->values}};
  const double before = rms_of(pairs, [](double x) { return x; });
  // Another convention explains all but roundings; that a coarse ground is farther explains less.
  constexpr double kMostLeftOfDepth = 0.2;
  const auto offer = [&](Systematic kind, double before_m, double after_m, std::string text) {
    findings.offer(kind, before_m, after_m, std::move(text), kMostLeftOfDepth);
  };
  const LineFit line = fit_line(pairs);
  offer(Systematic::DepthScale, before,
        rms_of(pairs, [&](double x) { return line.slope * x + line.intercept; }),
        fmt::format("the candidate's depth is the reference's times {:.6g} plus {:.4g} m",
                    line.slope, line.intercept));
  std::vector<float> inverse(a->values.size());
  std::transform(a->values.begin(), a->values.end(), inverse.begin(),
                 [](float z) { return 1.0f / z; });
  const std::vector<PlanePair> inverted{{inverse, b->values}};
  const LineFit window = fit_line(inverted);
  offer(Systematic::WindowDepth, before,
        rms_of(inverted, [&](double x) { return window.slope * x + window.intercept; }),
        fmt::format("the candidate's depth is {:.6g} {:+.6g} / the reference's: window depth, {}",
                    window.intercept, window.slope,
                    window.slope > 0.0 ? "reversed, large is near" : "small is near"));
  const std::optional<Camera> camera = image::camera_of(reference.metadata);
  if (!camera || static_cast<std::size_t>(camera->width_px) * camera->height_px != reference.size())
    return;
  const std::vector<float> lengths = ray_lengths(*camera);
  std::vector<float> distances(lengths.size());
  for (std::size_t k = 0; k < lengths.size(); ++k) distances[k] = lengths[k] * a->values[k];
  offer(Systematic::DistanceAsDepth, before,
        rms_of({PlanePair{distances, b->values}}, [](double x) { return x; }),
        "the candidate's depth is the distance along the ray");
}

// The least depth above zero.
double nearest_of(const PlaneImage& picture) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const float z : picture.find("Z")->values) {
    if (z > 0.0f) nearest = std::min(nearest, double{z});
  }
  return nearest;
}

// Depth as a picture: 1 where it is nearest, 0 for sky; planes are straight in it.
Grid<float> nearness_of(const PlaneImage& picture, double nearest_m) {
  Grid<float> nearness(picture.width_px, picture.height_px);
  const std::vector<float>& depth = picture.find("Z")->values;
  for (std::size_t k = 0; k < depth.size(); ++k)
    nearness.values()[k] = depth[k] > 0.0f ? static_cast<float>(nearest_m / depth[k]) : 0.0f;
  return nearness;
}

}  // namespace

Grid<float> luma_of(const PlaneImage& picture) {
  const Plane *r = picture.find("R"), *g = picture.find("G"), *b = picture.find("B");
  if (r == nullptr || g == nullptr || b == nullptr) r = g = b = picture.find("Y");
  if (r == nullptr) return {};
  Grid<float> luma(picture.width_px, picture.height_px);
  const std::span<float> values = luma.values();
  parallel_for(static_cast<std::int64_t>(picture.size()), 65536, [&](std::int64_t at) {
    const auto k = static_cast<std::size_t>(at);
    const double y = 0.2126 * r->values[k] + 0.7152 * g->values[k] + 0.0722 * b->values[k];
    values[k] = std::isfinite(y) ? static_cast<float>(y) : 0.0f;
  });
  return luma;
}

std::vector<Diagnosis> diagnose(const PlaneImage& reference, const PlaneImage& candidate) {
  Findings findings;
  if (const auto pairs = colour_pairs(reference, candidate); !pairs.empty()) {
    look_at_values(pairs, findings);
    look_at_places(luma_of(reference), luma_of(candidate), findings);
  }
  look_at_depth(reference, candidate, findings);
  if (colour_pairs(reference, candidate).empty() && reference.find("Z") != nullptr) {
    const double nearest_m = std::min(nearest_of(reference), nearest_of(candidate));
    look_at_places(nearness_of(reference, nearest_m), nearness_of(candidate, nearest_m), findings);
  }
  return findings.sorted();
}

}  // namespace plumb::compare
