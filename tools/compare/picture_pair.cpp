#include "compare/picture_pair.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/display_encoding.h"
#include "core/check.h"
#include "core/parallel.h"

namespace plumb::compare {
namespace {

std::set<std::string> names_of(const image::PlaneImage& picture) {
  std::set<std::string> names;
  for (const image::Plane& plane : picture.planes) names.insert(plane.name);
  return names;
}

}  // namespace

void require_comparable(const PicturePair& pair) {
  const image::PlaneImage &a = pair.reference, &b = pair.candidate;
  if (a.width_px != b.width_px || a.height_px != b.height_px)
    input_error("pictures of different size: '{}' has {} x {} pixels, '{}' has {} x {}",
                pair.reference_name, a.width_px, a.height_px, pair.candidate_name, b.width_px,
                b.height_px);
  if (const auto here = names_of(a), there = names_of(b); here != there)
    input_error("pictures with different channels: '{}' has {}, '{}' has {}", pair.reference_name,
                fmt::join(here, " "), pair.candidate_name, fmt::join(there, " "));
  if (a.encoding != b.encoding)
    input_error("pictures of unlike kinds: '{}' is {}, '{}' is {}", pair.reference_name,
                image::name_of(a.encoding), pair.candidate_name, image::name_of(b.encoding));
  if (!pair.mask.empty() && pair.mask.size() != pair.size())
    input_error("the mask has {} pixels, expected {} x {} as '{}' has", pair.mask.size(),
                a.width_px, a.height_px, pair.reference_name);
  if (!pair.mask.empty() &&
      std::find(pair.mask.begin(), pair.mask.end(), std::uint8_t{1}) == pair.mask.end())
    input_error("the mask is black everywhere: nothing of '{}' is left to be judged",
                pair.candidate_name);
}

std::vector<const image::Plane*> colour_planes(const image::PlaneImage& picture) {
  const image::Plane *r = picture.find("R"), *g = picture.find("G"), *b = picture.find("B");
  if (r != nullptr && g != nullptr && b != nullptr) return {r, g, b};
  const image::Plane* y = picture.find("Y");
  if (y != nullptr) return {y, y, y};
  return {};
}

std::vector<std::vector<float>> display_colour(const image::PlaneImage& picture) {
  std::vector<std::vector<float>> display;
  static const DisplayEncoding encoded;
  const bool encode = picture.encoding == image::Encoding::Linear;
  for (const image::Plane* plane : colour_planes(picture)) {
    std::vector<float> values(plane->values.size());
    parallel_for(static_cast<std::int64_t>(values.size()), 65536, [&](std::int64_t at) {
      const auto k = static_cast<std::size_t>(at);
      const float stored = plane->values[k];
      values[k] = !std::isfinite(stored) ? 0.0f : encode ? encoded(stored) : stored;
    });
    display.push_back(std::move(values));
  }
  return display;
}

}  // namespace plumb::compare
