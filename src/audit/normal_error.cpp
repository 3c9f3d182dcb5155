// The angle between what a pixel shows and the truth's slope there.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "audit/pixel_error.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"

namespace plumb::audit {
namespace {

glm::dvec3 normal_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return area_normal(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]);
}

// Sine and cosine of some pixels' angles, times one length.
struct Angles {
  static constexpr std::size_t kMost = 256;
  std::array<double, kMost> sine, cosine, angle_rad;
  std::array<std::size_t, kMost> pixel;
  std::size_t count = 0;

  void add(std::size_t at, const glm::dvec3& expected, const glm::dvec3& normal) {
    const glm::dvec3 across = glm::cross(expected, normal);
    sine[count] = std::sqrt(glm::dot(across, across));
    cosine[count] = glm::dot(expected, normal);
    pixel[count++] = at;
  }

  void give(std::vector<float>& errors) {
    reproducible_atan2(std::span(sine).first(count), std::span(cosine).first(count),
                       std::span(angle_rad).first(count));
    for (std::size_t k = 0; k < count; ++k)
      errors[pixel[k]] = static_cast<float>(degrees(angle_rad[k]));
  }
};

// expected(triangle of the truth) -> its normal; two_sided: the drawn side that is seen from above.
template <class Expected>
std::vector<float> normal_errors(const HitImage& true_hits, const TriangleMesh& mesh,
                                 const HitImage& drawn, bool two_sided, const Expected& expected) {
  std::vector<float> errors(drawn.size(), std::numeric_limits<float>::quiet_NaN());
  const std::size_t runs = (drawn.size() + Angles::kMost - 1) / Angles::kMost;
  parallel_for(static_cast<std::int64_t>(runs), 16, [&](std::int64_t run) {
    const std::size_t first = static_cast<std::size_t>(run) * Angles::kMost;
    Angles angles;
    for (std::size_t pixel = first; pixel < std::min(first + Angles::kMost, drawn.size());
         ++pixel) {
      if (!drawn.hit(pixel) || !true_hits.hit(pixel)) continue;
      const glm::dvec3 normal = normal_of(mesh, drawn.primitive[pixel]);
      angles.add(pixel, expected(true_hits.primitive[pixel]),
                 two_sided && normal.z < 0.0 ? -normal : normal);
    }
    angles.give(errors);
  });
  return errors;
}

}  // namespace

std::vector<float> normal_errors_deg(const HeightfieldTruth& truth, const HitImage& true_hits,
                                     const TriangleMesh& mesh, const HitImage& drawn) {
  // A sheet has two sides.
  return normal_errors(true_hits, mesh, drawn, true, [&](std::uint32_t triangle) {
    return reference::triangle_normal(truth.field(), truth.diagonal(), triangle);
  });
}

std::vector<float> normal_errors_deg(const TriangleMesh& truth, const HitImage& true_hits,
                                     const TriangleMesh& mesh, const HitImage& drawn) {
  return normal_errors(true_hits, mesh, drawn, false,
                       [&](std::uint32_t triangle) { return normal_of(truth, triangle); });
}

}  // namespace plumb::audit
