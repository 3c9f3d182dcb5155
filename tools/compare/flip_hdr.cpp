#include <algorithm>
#include <cmath>

#include "compare/flip_ldr.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"

namespace plumb::compare {
namespace {

constexpr double kMostStops = 120.0;  // 2^120 is a float
constexpr int kMostExposures = 1000;

struct Curve {
  double k[6];
  bool by_luminance;
};

// ACES in Narkowicz's fit with its exposure of 0.6; Hable's with an exposure of 2 and white
// at 11.2.
Curve curve_of(ToneMapper mapper) {
  switch (mapper) {
    case ToneMapper::Hable:
      return {{0.231683, 0.013791, 0.0, 0.18, 0.3, 0.018}, false};
    case ToneMapper::Reinhard:
      return {{0.0, 1.0, 0.0, 0.0, 1.0, 1.0}, true};
    case ToneMapper::Aces:
      break;
  }
  return {{0.36 * 2.51, 0.6 * 0.03, 0.0, 0.36 * 2.43, 0.6 * 0.59, 0.14}, false};
}

// The light that the curve maps to 0.85.
double light_for_bright(const Curve& curve) {
  constexpr double kBright = 0.85;
  const double a = curve.k[0] - kBright * curve.k[3], b = curve.k[1] - kBright * curve.k[4];
  const double c = curve.k[2] - kBright * curve.k[5];
  if (a == 0.0) return -c / b;
  const double middle = -0.5 * b / a;
  return middle + std::sqrt(middle * middle - c / a);
}

struct Luminance {
  double largest = 0.0, median = 0.0;
};

double upper_median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Luminance luminance_of(const ColourPlanes& picture) {
  std::vector<double> values(picture.r.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] = 0.2126 * std::max(picture.r[k], 0.0f) + 0.7152 * std::max(picture.g[k], 0.0f) +
                0.0722 * std::max(picture.b[k], 0.0f);
  }
  Luminance luminance;
  luminance.largest = *std::max_element(values.begin(), values.end());
  if (luminance.largest == 0.0) return luminance;
  luminance.median = upper_median(values);
  if (luminance.median > 0.0) return luminance;
  std::erase(values, 0.0);
  luminance.median = upper_median(values);
  return luminance;
}

double bounded(double stops) { return std::clamp(stops, -kMostStops, kMostStops); }

void require_valid(const HdrFlipOptions& options) {
  for (const auto& stops : {options.start_stops, options.stop_stops}) {
    require(!stops || std::abs(*stops) <= kMostStops, "exposures must lie within {} stops, got {}",
            kMostStops, stops.value_or(0.0));
  }
  require(!options.exposures || (*options.exposures >= 1 && *options.exposures <= kMostExposures),
          "exposures must be in [1, {}], got {}", kMostExposures, options.exposures.value_or(0));
}

void take_larger(const std::vector<float>& error, int exposure, HdrFlip& result) {
  for (std::size_t k = 0; k < error.size(); ++k) {
    if (!(error[k] > result.largest.error[k])) continue;
    result.largest.error[k] = error[k];
    result.exposure_index[k] = exposure;
  }
}

}  // namespace

ExposureRange flip_exposures(const ColourPlanes& reference_linear, const HdrFlipOptions& options) {
  require_valid(options);
  require_usable(reference_linear, "reference");
  ExposureRange range;
  if (!options.start_stops || !options.stop_stops) {
    const Luminance luminance = luminance_of(reference_linear);
    const double bright = light_for_bright(curve_of(options.tone_mapper));
    if (luminance.largest > 0.0) {
      range.start_stops = bounded(reproducible_log2(bright / luminance.largest));
      range.stop_stops = bounded(reproducible_log2(bright / luminance.median));
    }
  }
  range.start_stops = options.start_stops.value_or(range.start_stops);
  range.stop_stops = options.stop_stops.value_or(range.stop_stops);
  require(range.start_stops <= range.stop_stops,
          "the first exposure must not lie after the last, got {} and {} stops", range.start_stops,
          range.stop_stops);
  const int between = static_cast<int>(std::ceil(range.stop_stops - range.start_stops));
  range.count = options.exposures.value_or(std::max(2, between));
  return range;
}

HdrFlip flip_hdr(const ColourPlanes& reference_linear, const ColourPlanes& candidate_linear,
                 const HdrFlipOptions& options) {
  require_same_size(reference_linear, candidate_linear);
  require_usable(candidate_linear, "candidate");
  HdrFlip result;
  result.range = flip_exposures(reference_linear, options);
  result.largest = {reference_linear.width_px, reference_linear.height_px,
                    std::vector<float>(reference_linear.r.size(), 0.0f)};
  result.exposure_index.assign(result.largest.error.size(), 0);

  const FlipFilters filters = flip_filters(options.pixels_per_degree);
  const FlipKernels& kernels = flip_kernels(instruction_set());
  const Curve exact = curve_of(options.tone_mapper);
  ToneCurve curve{{}, exact.by_luminance};
  for (int k = 0; k < 6; ++k) curve.k[k] = static_cast<float>(exact.k[k]);

  OpponentPlanes reference(result.largest.width_px, result.largest.height_px);
  OpponentPlanes candidate(result.largest.width_px, result.largest.height_px);
  std::vector<float> error;
  for (int k = 0; k < result.range.count; ++k) {
    const auto gain = static_cast<float>(reproducible_pow(2.0, result.range.stops(k)));
    const MakeLinear expose = [&](int count, float* const rgb[3]) {
      kernels.expose(curve, gain, count, rgb);
    };
    fill(reference, reference_linear, kernels, expose);
    fill(candidate, candidate_linear, kernels, expose);
    flip_errors(reference, candidate, filters, kernels, error);
    take_larger(error, k, result);
  }
  return result;
}

}  // namespace plumb::compare
