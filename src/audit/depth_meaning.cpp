#include "audit/depth_meaning.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"

namespace plumb::audit {
namespace {

constexpr double kSky = DepthRange::kSky;

struct NamedConvention {
  const char* name;
  DepthConvention convention;
};

constexpr std::array<NamedConvention, 8> kConventions{{{"linear", DepthConvention::Linear},
                                                       {"distance", DepthConvention::Distance},
                                                       {"window", DepthConvention::Window},
                                                       {"opengl", DepthConvention::Window},
                                                       {"d3d", DepthConvention::Window},
                                                       {"vulkan", DepthConvention::Window},
                                                       {"opengl-ndc", DepthConvention::Ndc},
                                                       {"reverse-z", DepthConvention::ReverseZ}}};

// 0 at the near plane, 1 at the far one; grows with depth for each convention.
double far_share(double number, DepthConvention convention) {
  return convention == DepthConvention::Window ? number
         : convention == DepthConvention::Ndc  ? 0.5 * (number + 1.0)
                                               : 1.0 - number;
}

// 1/w of each end; the share of the near plane is kept apart, so that a reversed depth next to 0
// keeps its digits.
double depth_of_window(double number, DepthConvention convention, const Camera& camera) {
  const double near_share = convention == DepthConvention::Window ? 1.0 - number
                            : convention == DepthConvention::Ndc  ? 0.5 * (1.0 - number)
                                                                  : number;
  const double inverse = near_share / camera.near_m + far_share(number, convention) / camera.far_m;
  return inverse > 0.0 ? 1.0 / inverse : kSky;
}

std::optional<DepthRange> window_range(double stored, const image::NumberFormat& format,
                                       const DepthMeaning& meaning, const Camera& camera) {
  const bool is_ndc = meaning.convention == DepthConvention::Ndc;
  const double least = is_ndc ? -1.0 : 0.0;
  if (!(stored >= least && stored <= 1.0)) return std::nullopt;
  image::NumberRange held = image::numbers_held_as(stored, format);
  held = {std::max(held.low, least), std::min(held.high, 1.0)};
  const bool reversed = meaning.convention == DepthConvention::ReverseZ;
  const double cleared = reversed ? 0.0 : 1.0;
  const auto depth = [&](double number) {
    return depth_of_window(number, meaning.convention, camera);
  };
  DepthRange range{depth(reversed ? held.high : held.low), depth(stored),
                   depth(reversed ? held.low : held.high)};
  if (stored == cleared) range.value = range.high = kSky;
  return range;
}

}  // namespace

const char* name_of(DepthConvention convention) {
  for (const NamedConvention& named : kConventions) {
    if (named.convention == convention) return named.name;
  }
  return "?";
}

const std::vector<std::string>& depth_convention_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const NamedConvention& named : kConventions) list.emplace_back(named.name);
    return list;
  }();
  return names;
}

DepthConvention parse_depth_convention(const std::string& text) {
  std::string names;
  for (const NamedConvention& named : kConventions) {
    if (text == named.name) return named.convention;
    names += (names.empty() ? "" : ", ") + std::string(named.name);
  }
  input_error("depth convention '{}': expected one of {}", text, names);
}

std::optional<DepthRange> depth_range(float stored, const image::NumberFormat& format,
                                      const DepthMeaning& meaning, const Camera& camera,
                                      double ray_length) {
  const double number = stored;
  if (std::isnan(number)) return std::nullopt;
  if (meaning.sky && stored == static_cast<float>(*meaning.sky))
    return DepthRange{kSky, kSky, kSky};
  const bool along_ray = meaning.convention == DepthConvention::Distance;
  if (!along_ray && meaning.convention != DepthConvention::Linear)
    return window_range(number, format, meaning, camera);
  if (std::isinf(number)) {
    const bool far = (number > 0.0) == (meaning.metres_per_unit > 0.0);
    return far ? std::optional(DepthRange{kSky, kSky, kSky}) : std::nullopt;
  }
  const double factor = meaning.metres_per_unit / (along_ray ? ray_length : 1.0);
  if (!(number * factor > 0.0)) return std::nullopt;
  const image::NumberRange held = image::numbers_held_as(number, format);
  const auto [low, high] = std::minmax({held.low * factor, held.high * factor});
  return DepthRange{std::max(0.0, low), number * factor, high};
}

std::optional<DepthRange> depth_range_at(const image::DepthBuffer& buffer,
                                         const DepthMeaning& meaning, const Camera& camera, int x,
                                         int y) {
  const glm::dvec3 ray = ray_direction(camera, x + 0.5, y + 0.5);
  return depth_range(buffer.values[stored_index(buffer, meaning, x, y)], buffer.format, meaning,
                     camera, std::sqrt(glm::dot(ray, ray)));
}

}  // namespace plumb::audit
