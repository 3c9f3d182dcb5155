#include "mesh/dual_contouring/vertex_place.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "mesh/dual_contouring/cell_loops.h"
#include "mesh/dual_contouring/symmetric_eigen.h"

namespace plumb::mesh::dual_contouring {
namespace {

// A singular value of the planes' matrix counts as zero below this part of the largest, a customary
// value: where two faces turn by less than 11 degrees (the tangent of half of it is below 0.1),
// they are one, and the vertex keeps the mean's place along them.
constexpr double kSingularPart = 0.1;

// Steps, damping and end as programs that name [Schmitz, Dietrich & Comba 2009] have them: the k-th
// step moves by (1 - k / 50) of the mean force. The paper itself was not at hand.
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

// Where an edge crosses: its corners, and how far along it.
struct Crossing {
  std::size_t low = 0, high = 0, axis = 0;
  double part = 0.0;

  /// Its coordinate along an axis of the cell.
  double at(std::size_t along) const {
    return along == axis ? part : static_cast<double>(low >> along & 1);
  }
  glm::dvec3 place() const { return {at(0), at(1), at(2)}; }
};

struct EdgeEnds {
  std::size_t low = 0, high = 0, axis = 0;
};

constexpr std::array<EdgeEnds, kCellEdges> ends_of_edges() {
  std::array<EdgeEnds, kCellEdges> ends{};
  for (int edge = 0; edge < kCellEdges; ++edge) {
    const int low = lower_corner(edge), axis = edge / 4;
    ends[static_cast<std::size_t>(edge)] = {static_cast<std::size_t>(low),
                                            static_cast<std::size_t>(low | 1 << axis),
                                            static_cast<std::size_t>(axis)};
  }
  return ends;
}
constexpr std::array<EdgeEnds, kCellEdges> kEnds = ends_of_edges();

// Crossings in the order of their edges.
template <class Body>
void for_crossings(const CellCorners& corners, std::uint16_t edges, const Body& body) {
  for (unsigned left = edges; left != 0; left &= left - 1) {
    const auto& [low, high, axis] = kEnds[static_cast<std::size_t>(std::countr_zero(left))];
    const double a = corners.density[low], b = corners.density[high];
    body(Crossing{low, high, axis, (0.5 - a) / (b - a)});
  }
}

glm::dvec3 mean_of(const CellCorners& corners, std::uint16_t edges) {
  double x = 0.0, y = 0.0, z = 0.0;
  int count = 0;
  for_crossings(corners, edges, [&](const Crossing& crossing) {
    x += crossing.at(0);
    y += crossing.at(1);
    z += crossing.at(2);
    ++count;
  });
  return glm::dvec3(x, y, z) / static_cast<double>(count);
}

// The planes of the crossings, about their mean: the force on a particle at mean + x is
// pull - normals * x, the sum of its distances to the planes along their normals.
struct Planes {
  glm::dvec3 mean{0.0};
  int crossings = 0;
  SymmetricMatrix normals;  // sum of n n^T
  glm::dvec3 pull{0.0};     // sum of n (n . (place - mean))
};

Planes planes_of(const CellCorners& corners, std::uint16_t edges) {
  Planes planes;
  planes.mean = mean_of(corners, edges);
  planes.crossings = std::popcount(edges);
  for_crossings(corners, edges, [&](const Crossing& crossing) {
    const glm::dvec3 &a = corners.gradient[crossing.low], &b = corners.gradient[crossing.high];
    const glm::dvec3 gradient = a + crossing.part * (b - a);
    const double squared = dot(gradient, gradient);
    if (!(squared > 0.0)) return;  // no plane where nothing is known of it
    const glm::dvec3 n = gradient / std::sqrt(squared);
    planes.normals.diagonal += n * n;
    planes.normals.xy += n.x * n.y;
    planes.normals.xz += n.x * n.z;
    planes.normals.yz += n.y * n.z;
    planes.pull += n * dot(n, crossing.place() - planes.mean);
  });
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
  if (placement == Placement::Mean) return mean_of(corners, edges);
  const Planes planes = planes_of(corners, edges);
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
