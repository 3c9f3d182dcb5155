#include "compare/flip_ldr.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::compare {
namespace {

constexpr int kBandRows = 16;

bool all_finite(std::span<const float> values) {
  std::uint32_t most = 0;
  for (const float value : values)
    most = std::max(most, std::bit_cast<std::uint32_t>(value) & 0x7fffffffu);
  return most < 0x7f800000u;
}

// The rows that one output row needs, of one picture.
class PictureRow {
 public:
  PictureRow(const OpponentPlanes& planes, const FlipFilters& filters)
      : planes_(planes),
        taps_(filters.taps()),
        padded_(planes.stride + 2 * padding()),
        filtered_(static_cast<std::size_t>(padded_) * kFlipFilters, 0.0f),
        responses_(static_cast<std::size_t>(planes.stride) * kFlipResponses, 0.0f),
        rows_(6 * (static_cast<std::size_t>(taps_.reach) + 1)) {
    for (int f = 0; f < kFlipFilters; ++f)
      in_[f] = down_[f] = filtered_.data() + static_cast<std::size_t>(padded_) * f + padding();
    for (int k = 0; k < kFlipResponses; ++k)
      response[k] = responses_.data() + static_cast<std::size_t>(planes.stride) * k;
  }
  PictureRow(const PictureRow&) = delete;
  PictureRow& operator=(const PictureRow&) = delete;

  void filter(int y, const FlipKernels& kernels) {
    const std::size_t taps = static_cast<std::size_t>(taps_.reach) + 1;
    const float** rows = rows_.data();
    const float* const* above[3];
    const float* const* below[3];
    for (int p = 0; p < 3; ++p) {
      above[p] = rows + 2 * p * taps;
      below[p] = above[p] + taps;
      for (int k = 0; k <= taps_.reach; ++k) {
        rows[2 * p * taps + k] = planes_.row(p, std::max(y - k, 0));
        rows[(2 * p + 1) * taps + k] = planes_.row(p, std::min(y + k, planes_.height_px - 1));
      }
    }
    kernels.filter_down(taps_, above, below, planes_.stride, down_);
    for (float* row : down_) {
      std::fill(row - taps_.reach, row, row[0]);
      std::fill(row + planes_.width_px, row + planes_.width_px + taps_.reach,
                row[planes_.width_px - 1]);
    }
    kernels.filter_across(taps_, in_, planes_.stride, response);
  }

  float* response[kFlipResponses];

 private:
  // Both ends may be read `reach` floats too far.
  int padding() const { return (taps_.reach + kFlipLanes - 1) / kFlipLanes * kFlipLanes; }

  const OpponentPlanes& planes_;
  FlipTaps taps_;
  int padded_;
  std::vector<float> filtered_, responses_;
  std::vector<const float*> rows_;
  float* down_[kFlipFilters];
  const float* in_[kFlipFilters];
};

void errors_of_row(PictureRow& reference, PictureRow& candidate, const FlipKernels& kernels,
                   int stride, float* colour, float* feature) {
  const FlipConstants& constants = flip_constants();
  float* const* a = reference.response;
  float* const* b = candidate.response;
  kernels.to_hunt_lab(constants, stride, a);
  kernels.to_hunt_lab(constants, stride, b);
  kernels.differ_in_colour(constants, a, b, stride, colour);
  kernels.differ_in_features(a + kEdgeX, b + kEdgeX, stride, feature);
  kernels.combine(colour, feature, stride, colour);
}

}  // namespace

void require_usable(const ColourPlanes& picture, const char* name) {
  require(picture.width_px >= 1 && picture.height_px >= 1,
          "the {} must be at least 1 x 1, got {} x {}", name, picture.width_px, picture.height_px);
  const std::size_t pixels = static_cast<std::size_t>(picture.width_px) * picture.height_px;
  const std::span<const float> channels[] = {picture.r, picture.g, picture.b};
  for (int c = 0; c < 3; ++c) {
    const char letter = "rgb"[c];
    require(channels[c].size() == pixels, "channel {} of the {} must have {} values, got {}",
            letter, name, pixels, channels[c].size());
    if (all_finite(channels[c])) continue;
    const auto bad = std::find_if(channels[c].begin(), channels[c].end(),
                                  [](float value) { return !std::isfinite(value); });
    const auto k = static_cast<std::size_t>(bad - channels[c].begin());
    require(false, "the {}'s values must be finite, got {} in channel {} at ({}, {})", name, *bad,
            letter, k % picture.width_px, k / picture.width_px);
  }
}

void require_same_size(const ColourPlanes& reference, const ColourPlanes& candidate) {
  require(reference.width_px == candidate.width_px && reference.height_px == candidate.height_px,
          "both pictures must have one size, got {} x {} and {} x {}", reference.width_px,
          reference.height_px, candidate.width_px, candidate.height_px);
}

OpponentPlanes::OpponentPlanes(int width, int height)
    : width_px(width),
      height_px(height),
      stride((width + kFlipLanes - 1) / kFlipLanes * kFlipLanes) {
  for (auto& values : plane)
    values = std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(stride) * height);
}

void fill(OpponentPlanes& planes, const ColourPlanes& picture, const FlipKernels& kernels,
          const MakeLinear& make_linear) {
  const std::span<const float> channels[] = {picture.r, picture.g, picture.b};
  const FlipConstants& constants = flip_constants();
  parallel_for(planes.height_px, kBandRows, [&](std::int64_t y) {
    float* rgb[3];
    for (int c = 0; c < 3; ++c) {
      rgb[c] = planes.row(c, static_cast<int>(y));
      const auto from = channels[c].begin() + y * planes.width_px;
      std::copy(from, from + planes.width_px, rgb[c]);
      std::fill(rgb[c] + planes.width_px, rgb[c] + planes.stride, 0.0f);
    }
    make_linear(planes.stride, rgb);
    kernels.to_opponent(constants, planes.stride, rgb);
  });
}

void flip_errors(const OpponentPlanes& reference, const OpponentPlanes& candidate,
                 const FlipFilters& filters, const FlipKernels& kernels,
                 std::vector<float>& error) {
  const int width = reference.width_px, height = reference.height_px, stride = reference.stride;
  error.resize(static_cast<std::size_t>(width) * height);
  parallel_for((height + kBandRows - 1) / kBandRows, 1, [&](std::int64_t band) {
    PictureRow rows_of_reference(reference, filters), rows_of_candidate(candidate, filters);
    std::vector<float> colour(stride), feature(stride);
    const int begin = static_cast<int>(band) * kBandRows;
    for (int y = begin; y < std::min(begin + kBandRows, height); ++y) {
      rows_of_reference.filter(y, kernels);
      rows_of_candidate.filter(y, kernels);
      errors_of_row(rows_of_reference, rows_of_candidate, kernels, stride, colour.data(),
                    feature.data());
      std::copy(colour.begin(), colour.begin() + width,
                error.begin() + static_cast<std::ptrdiff_t>(y) * width);
    }
  });
}

FlipMap flip_ldr(const ColourPlanes& reference_srgb, const ColourPlanes& candidate_srgb,
                 const FlipOptions& options) {
  require_same_size(reference_srgb, candidate_srgb);
  require_usable(reference_srgb, "reference");
  require_usable(candidate_srgb, "candidate");
  const FlipFilters filters = flip_filters(options.pixels_per_degree);
  const FlipKernels& kernels = flip_kernels(instruction_set());
  const MakeLinear linearise = [&kernels](int count, float* const rgb[3]) {
    for (int c = 0; c < 3; ++c) kernels.linearise(rgb[c], count, rgb[c]);
  };
  FlipMap map{reference_srgb.width_px, reference_srgb.height_px, {}};
  OpponentPlanes reference(map.width_px, map.height_px), candidate(map.width_px, map.height_px);
  fill(reference, reference_srgb, kernels, linearise);
  fill(candidate, candidate_srgb, kernels, linearise);
  flip_errors(reference, candidate, filters, kernels, map.error);
  return map;
}

}  // namespace plumb::compare
