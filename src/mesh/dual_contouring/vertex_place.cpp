#include "mesh/dual_contouring/vertex_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mesh/dual_contouring/cell_loops.h"
#include "mesh/dual_contouring/symmetric_eigen.h"

namespace plumb::mesh::dual_contouring {
namespace {

// A singular value of the planes' matrix counts as zero below this part of the largest: where two
// faces meet at less than about 11 degrees, the vertex stays near the mass point along the edge's
// height. [Ju et al. 2002, section 2.3] cut at 0.1 as well, of normals of length one.
constexpr double kSingularPart = 0.1;

// As later authors state of [Schmitz et al. 2009]; the paper itself is not at hand.
constexpr int kParticleSteps = 50;
constexpr double kSmallForce = 1e-3;

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

template <class T>
T trilinear_of(const std::array<T, 8>& corners, const glm::dvec3& at) {
  const auto along = [](const T& a, const T& b, double t) { return a + t * (b - a); };
  std::array<T, 4> on_x{};
  for (std::size_t k = 0; k < 4; ++k) on_x[k] = along(corners[2 * k], corners[2 * k + 1], at.x);
  return along(along(on_x[0], on_x[1], at.y), along(on_x[2], on_x[3], at.y), at.z);
}

// Where an edge crosses: the place of its lower corner, moved along it.
struct Crossing {
  std::size_t low = 0, high = 0;  // corners
  double part = 0.0;
  glm::dvec3 place{0.0};
};

Crossing crossing_of(const CellCorners& corners, int edge) {
  const int axis = edge / 4, low = lower_corner(edge), high = low | 1 << axis;
  Crossing crossing{static_cast<std::size_t>(low), static_cast<std::size_t>(high), 0.0,
                    glm::dvec3(low & 1, low >> 1 & 1, low >> 2)};
  const double a = corners.density[crossing.low], b = corners.density[crossing.high];
  crossing.part = (0.5 - a) / (b - a);
  crossing.place[axis] = crossing.part;
  return crossing;
}

// The planes of the crossings, about their mean: the force on a particle at mean + x is
// pull - normals * x, the sum of its distances to the planes along their normals.
struct Planes {
  glm::dvec3 mean{0.0};
  int crossings = 0;
  SymmetricMatrix normals;  // sum of n n^T
  glm::dvec3 pull{0.0};     // sum of n (n . (place - mean))
};

Planes planes_of(const CellCorners& corners, std::uint16_t edges, bool with_normals) {
  Planes planes;
  std::array<Crossing, kCellEdges> crossings;
  for (int edge = 0; edge < kCellEdges; ++edge) {
    if ((edges >> edge & 1) == 0) continue;
    const Crossing crossing = crossing_of(corners, edge);
    planes.mean += crossing.place;
    crossings[static_cast<std::size_t>(planes.crossings++)] = crossing;
  }
  planes.mean /= static_cast<double>(planes.crossings);
  for (int k = 0; with_normals && k < planes.crossings; ++k) {
    const Crossing& crossing = crossings[static_cast<std::size_t>(k)];
    const glm::dvec3 &a = corners.gradient[crossing.low], &b = corners.gradient[crossing.high];
    const glm::dvec3 gradient = a + crossing.part * (b - a);
    const double squared = dot(gradient, gradient);
    if (!(squared > 0.0)) continue;  // no plane where nothing is known of it
    const glm::dvec3 n = gradient / std::sqrt(squared);
    planes.normals.diagonal += n * n;
    planes.normals.xy += n.x * n.y;
    planes.normals.xz += n.x * n.z;
    planes.normals.yz += n.y * n.z;
    planes.pull += n * dot(n, crossing.place - planes.mean);
  }
  return planes;
}

// From the mean to the least sum of squared distances, along the directions that the planes decide.
glm::dvec3 least_squares(const Planes& planes) {
  const SymmetricEigen eigen = eigen_of(planes.normals);
  const double largest = std::max({eigen.value[0], eigen.value[1], eigen.value[2]});
  glm::dvec3 moved{0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    if (eigen.value[k] > kSingularPart * kSingularPart * largest)
      moved += eigen.vector[k] * (dot(eigen.vector[k], planes.pull) / eigen.value[k]);
  }
  return moved;
}

// The paper tabulates the force at the cell's corners and interpolates it; the force is affine, so
// that what is interpolated is the force itself.
glm::dvec3 pulled_particle(const Planes& planes) {
  const SymmetricMatrix& m = planes.normals;
  glm::dvec3 x{0.0};
  for (int step = 0; step < kParticleSteps; ++step) {
    const glm::dvec3 force = planes.pull - glm::dvec3(m.diagonal.x * x.x + m.xy * x.y + m.xz * x.z,
                                                      m.xy * x.x + m.diagonal.y * x.y + m.yz * x.z,
                                                      m.xz * x.x + m.yz * x.y + m.diagonal.z * x.z);
    const double damping = 1.0 - static_cast<double>(step) / kParticleSteps;
    x += force * (damping / planes.crossings);
    if (dot(force, force) < kSmallForce * kSmallForce) break;
  }
  return x;
}

}  // namespace

const char* name_of(Placement placement) {
  switch (placement) {
    case Placement::Mean:
      return "mean";
    case Placement::Qef:
      return "qef";
    case Placement::Particle:
      return "particle";
  }
  return "";
}

glm::dvec3 place_vertex(const CellCorners& corners, std::uint16_t edges, Placement placement) {
  const Planes planes = planes_of(corners, edges, placement != Placement::Mean);
  if (placement == Placement::Mean) return planes.mean;
  const glm::dvec3 place =
      planes.mean + (placement == Placement::Qef ? least_squares(planes) : pulled_particle(planes));
  return {std::clamp(place.x, 0.0, 1.0), std::clamp(place.y, 0.0, 1.0),
          std::clamp(place.z, 0.0, 1.0)};
}

double trilinear(const std::array<float, 8>& corners, const glm::dvec3& at) {
  std::array<double, 8> wide{};
  std::copy(corners.begin(), corners.end(), wide.begin());
  return trilinear_of(wide, at);
}

glm::dvec3 trilinear(const std::array<glm::dvec3, 8>& corners, const glm::dvec3& at) {
  return trilinear_of(corners, at);
}

}  // namespace plumb::mesh::dual_contouring
