// Depth, points, normals, and the names of patches: each in its own unit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "compare/local_difference.h"
#include "compare/measuring.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "image/camera_metadata.h"

namespace plumb::compare {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr double kDegreesOfRadian = 57.29577951308232;
// Normals that are this near are alike: far below what a level of detail turns them by, far above
// what rounding does.
constexpr float kLikeNormals_cos = 0.99939083f;  // 2 degrees

struct Vectors {
  std::span<const float> x, y, z;

  glm::dvec3 at(std::size_t k) const { return {double{x[k]}, double{y[k]}, double{z[k]}}; }
  bool finite(std::size_t k) const {
    return std::isfinite(x[k]) && std::isfinite(y[k]) && std::isfinite(z[k]);
  }
};

std::optional<Vectors> vectors_of(const image::PlaneImage& picture, const std::string& name) {
  const image::Plane *x = picture.find(name + ".X"), *y = picture.find(name + ".Y"),
                     *z = picture.find(name + ".Z");
  if (x == nullptr || y == nullptr || z == nullptr) return std::nullopt;
  return Vectors{x->values, y->values, z->values};
}

// One over the depth, along which planes are straight on the screen; 0 for sky and what is none.
std::vector<float> nearness_of(const image::Plane& depth) {
  std::vector<float> nearness(depth.values.size());
  for (std::size_t k = 0; k < nearness.size(); ++k)
    nearness[k] =
        std::isfinite(depth.values[k]) && depth.values[k] > 0.0f ? 1.0f / depth.values[k] : 0.0f;
  return nearness;
}

void measure_local_depth(const Measuring& m, const image::Plane& reference,
                         const image::Plane& candidate) {
  if (!m.wants_any("depth", {"unexplained_share", "isolated_pixels"})) return;
  const std::vector<float> a = nearness_of(reference), b = nearness_of(candidate);
  const std::vector<std::span<const float>> there{a}, here{b};
  const LocalDifference local =
      local_difference(there, here, m.pair.width_px(), m.pair.height_px());
  const double above = m.profile.options.depth_above;
  std::size_t unexplained = 0, isolated = 0;
  std::optional<std::size_t> first;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!m.pair.judged(k) || a[k] == 0.0f || b[k] == 0.0f) continue;  // sky is coverage's
    const double unit = double{std::max(a[k], b[k])} * above;
    unexplained += double{local.unexplained[k]} > unit;
    const bool alone = double{local.isolated[k]} > unit;
    if (alone && !first) first = k;
    isolated += alone;
  }
  m.add("depth", "unexplained_share", share_of(m.pair, unexplained));
  m.add("depth", "isolated_pixels", static_cast<double>(isolated), first);
}

}  // namespace

void measure_depth(const Measuring& m) {
  const image::Plane *reference = m.pair.reference.find("Z"),
                     *candidate = m.pair.candidate.find("Z");
  if (reference == nullptr || candidate == nullptr) return;
  std::vector<float> relative(m.pair.size(), kNothing);
  for (std::size_t k = 0; k < relative.size(); ++k) {
    const double a = double{reference->values[k]}, b = double{candidate->values[k]};
    if (m.pair.judged(k) && std::isfinite(a) && std::isfinite(b))
      relative[k] = a == b ? 0.0f : static_cast<float>(std::abs(b - a) / std::abs(a));
  }
  const Spread spread = spread_of(relative);
  m.add("depth", "relative_largest", spread.largest,
        spread.largest > 0.0 ? std::optional(spread.worst) : std::nullopt);
  m.add("depth", "relative_mean", spread.mean);
  m.add("depth", "relative_p99", spread.p99);
  measure_local_depth(m, *reference, *candidate);
  m.keep_map({"depth", "difference of the depths, divided by the reference's", "",
              std::move(relative), m.bound("depth", "relative_largest")});
}

void measure_positions(const Measuring& m) {
  const auto reference = vectors_of(m.pair.reference, "P"),
             candidate = vectors_of(m.pair.candidate, "P");
  const image::Plane* depth = m.pair.reference.find("Z");
  const std::optional<Camera> camera = image::camera_of(m.pair.reference.metadata);
  if (!reference || !candidate || depth == nullptr || !camera) return;
  const image::Plane* candidate_depth = m.pair.candidate.find("Z");
  const double gamma = std::max(camera->gamma_h, camera->gamma_v);
  std::vector<float> apart_px(m.pair.size(), kNothing);
  for (std::size_t k = 0; k < apart_px.size(); ++k) {
    const double z = double{depth->values[k]};
    if (!m.pair.judged(k) || !std::isfinite(z) || !(z > 0.0) ||
        (candidate_depth != nullptr && !std::isfinite(candidate_depth->values[k])) ||
        !reference->finite(k) || !candidate->finite(k))
      continue;
    apart_px[k] = static_cast<float>(glm::length(candidate->at(k) - reference->at(k)) * gamma / z);
  }
  const Spread spread = spread_of(apart_px);
  m.add("position", "largest_px", spread.largest,
        spread.largest > 0.0 ? std::optional(spread.worst) : std::nullopt);
  m.add("position", "mean_px", spread.mean);
  m.add("position", "p99_px", spread.p99);
  m.keep_map({"position", "distance of the points seen, as wide as it looks at their depth", "px",
              std::move(apart_px), m.bound("position", "largest_px")});
}

namespace {

// Whether the normal of `from` is one of the 3 x 3 around in `to`.
bool has_like_normal(const Vectors& from, const Vectors& to, int x, int y, int width, int height) {
  const auto index = [&](int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(i);
  };
  const std::size_t k = index(x, y);
  for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i) {
      const std::size_t o = index(i, j);
      if (from.x[k] * to.x[o] + from.y[k] * to.y[o] + from.z[k] * to.z[o] >= kLikeNormals_cos)
        return true;
    }
  }
  return false;
}

}  // namespace

void measure_normals(const Measuring& m) {
  const auto reference = vectors_of(m.pair.reference, "N"),
             candidate = vectors_of(m.pair.candidate, "N");
  if (!reference || !candidate) return;
  const int width = m.pair.width_px(), height = m.pair.height_px();
  std::vector<float> angle_deg(m.pair.size(), kNothing);
  std::vector<std::uint8_t> unmatched(m.pair.size(), 0);
  parallel_for(height, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      const std::size_t k = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x);
      if (!m.pair.judged(k) || !reference->finite(k) || !candidate->finite(k)) continue;
      const glm::dvec3 a = reference->at(k), b = candidate->at(k);
      if (glm::dot(a, a) == 0.0 || glm::dot(b, b) == 0.0) continue;  // sky
      angle_deg[k] = a == b ? 0.0f
                            : static_cast<float>(kDegreesOfRadian *
                                                 reproducible_atan2(glm::length(glm::cross(a, b)),
                                                                    glm::dot(a, b)));
      unmatched[k] = has_like_normal(*candidate, *reference, x, y, width, height) ||
                             has_like_normal(*reference, *candidate, x, y, width, height)
                         ? 0
                         : 1;
    }
  });
  const Spread spread = spread_of(angle_deg);
  m.add("normal", "largest_deg", spread.largest,
        spread.largest > 0.0 ? std::optional(spread.worst) : std::nullopt);
  m.add("normal", "mean_deg", spread.mean);
  m.add("normal", "p99_deg", spread.p99);
  m.add("normal", "unmatched_share",
        share_of(m.pair, static_cast<std::size_t>(
                             std::count(unmatched.begin(), unmatched.end(), std::uint8_t{1}))));
  m.keep_map({"normal", "angle between the normals", "deg", std::move(angle_deg),
              m.bound("normal", "largest_deg")});
}

namespace {

using Confusion = std::map<std::pair<float, float>, std::size_t>;

// The pairs that are seen most.
void note_confusion(const Measuring& m, const std::string& name, const Confusion& pairs) {
  constexpr std::size_t kMostNamed = 3;
  std::vector<std::pair<std::pair<float, float>, std::size_t>> order(pairs.begin(), pairs.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  order.resize(std::min(order.size(), kMostNamed));
  for (const auto& [values, pixels] : order)
    m.result.notes.push_back(fmt::format("{} {} of the reference is {} in {} pixels", name,
                                         values.first, values.second, pixels));
}

}  // namespace

void measure_names(const Measuring& m) {
  for (const char* name : {"id", "lod"}) {
    const image::Plane *reference = m.pair.reference.find(name),
                       *candidate = m.pair.candidate.find(name);
    if (reference == nullptr || candidate == nullptr) continue;
    std::size_t differing = 0;
    Confusion pairs;
    std::optional<std::size_t> first;
    for (std::size_t k = 0; k < m.pair.size(); ++k) {
      const float a = reference->values[k], b = candidate->values[k];
      if (!m.pair.judged(k) || a == b || !std::isfinite(a) || !std::isfinite(b)) continue;
      ++differing;
      ++pairs[{a, b}];
      if (!first) first = k;
    }
    m.add(name, "differing_share", share_of(m.pair, differing), first);
    m.add(name, "confused_pairs", static_cast<double>(pairs.size()));
    note_confusion(m, name, pairs);
  }
}

}  // namespace plumb::compare
