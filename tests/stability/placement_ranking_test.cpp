// Which place of a cell's vertex is best: mean, qef and particle on solids whose surface is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/reproducible_math.h"
#include "mesh/dual_contouring/attributes.h"
#include "mesh/dual_contouring/quadrangulate.h"
#include "support/test_lattices.h"

namespace plumb::mesh::dual_contouring {
namespace {

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const glm::dvec3& v) { return std::sqrt(dot(v, v)); }

// A signed distance, positive outside, voxels.
struct Shape {
  const char* name;
  std::function<double(const glm::dvec3&)> outside;
};

// Turned, so that no face lies along the lattice: rows of a rotation by thirds and sevenths.
glm::dvec3 turned(const glm::dvec3& p) {
  const glm::dvec3 a(2.0 / 3, -1.0 / 3, 2.0 / 3), b(2.0 / 3, 2.0 / 3, -1.0 / 3);
  const glm::dvec3 q(dot(a, p), dot(b, p), dot({-1.0 / 3, 2.0 / 3, 2.0 / 3}, p));
  return {(6 * q.x + 2 * q.y + 3 * q.z) / 7, (-3 * q.x + 6 * q.y + 2 * q.z) / 7,
          (-2 * q.x - 3 * q.y + 6 * q.z) / 7};
}

const glm::dvec3 kCentre(0.3, -0.2, 0.1);

double outside_box(const glm::dvec3& p) {
  const glm::dvec3 q = turned(p - kCentre), half(14, 11, 9);
  const glm::dvec3 over(std::abs(q.x) - half.x, std::abs(q.y) - half.y, std::abs(q.z) - half.z);
  const glm::dvec3 beyond(std::max(over.x, 0.0), std::max(over.y, 0.0), std::max(over.z, 0.0));
  return length(beyond) + std::min(std::max({over.x, over.y, over.z}), 0.0);
}

double outside_torus(const glm::dvec3& p) {
  const glm::dvec3 q = turned(p - kCentre);
  const double across = std::sqrt(q.x * q.x + q.y * q.y) - 14.0;
  return std::sqrt(across * across + q.z * q.z) - 6.0;
}

const Shape kPlane{"plane", [](const glm::dvec3& p) { return turned(p - kCentre).z; }};
const Shape kSphere{"sphere", [](const glm::dvec3& p) { return length(p - kCentre) - 18.0; }};
const Shape kTorus{"torus", outside_torus};
const Shape kBox{"box", outside_box};

glm::dvec3 gradient(const Shape& shape, const glm::dvec3& p) {
  constexpr double kStep = 1e-5;
  glm::dvec3 slope(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 before = p, after = p;
    before[axis] -= kStep;
    after[axis] += kStep;
    slope[axis] = shape.outside(after) - shape.outside(before);
  }
  return slope / length(slope);
}

// The root t of d(p + t n), n the gradient of d at p, by bisection between 4 voxels on both sides.
double distance_to(const Shape& shape, const glm::dvec3& p, const glm::dvec3& n) {
  double low = -4.0, high = 4.0;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (shape.outside(p + middle * n) > 0.0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

struct Spread {
  double max = 0.0, squares = 0.0;
  std::size_t count = 0;

  void add(double value) {
    max = std::max(max, value);
    squares += value * value;
    ++count;
  }
  double rms() const { return std::sqrt(squares / static_cast<double>(count)); }
};

struct Rank {
  Spread distance, vertex_normal_deg, face_normal_deg;
  double nanoseconds = 0.0;  // a vertex, at best
};

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  const double turn = dot(a, b) / (length(a) * length(b));
  return std::acos(std::clamp(turn, -1.0, 1.0)) * 180.0 / kPi;
}

// Near the lattice's border the plane ends.
bool is_within(const glm::dvec3& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 24.0;
}

double nanoseconds_of(const Lattice<float>& density, const ActiveCells& active,
                      Placement placement) {
  double best = 1e30;
  for (int round = 0; round < 9; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const auto positions = vertex_positions(density, active, placement);
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count() / static_cast<double>(positions.size()));
  }
  return best;
}

void add_faces(const Shape& shape, const std::vector<glm::dvec3>& at,
               const std::vector<Quad>& quads, Rank& rank) {
  for (const Quad& quad : quads) {
    for (const auto& [a, b, c] :
         {std::array{quad[0], quad[1], quad[2]}, std::array{quad[0], quad[2], quad[3]}}) {
      const glm::dvec3 middle = (at[a] + at[b] + at[c]) / 3.0;
      const glm::dvec3 normal = area_normal(at[a], at[b], at[c]);
      if (!is_within(middle) || length(normal) < 1e-6) continue;
      rank.face_normal_deg.add(degrees_between(normal, gradient(shape, middle)));
    }
  }
}

Rank rank_of(const Shape& shape, Placement placement) {
  // Full 4 voxels within, empty 4 voxels outside, linear between: all that Sobel's operator looks
  // at lies within 2 sqrt(3) of a crossing cell's surface.
  const Lattice<float> density = testing::sampled_lattice(
      {glm::ivec3(-28), glm::ivec3(57)},
      [&](const glm::dvec3& p) { return std::clamp(0.5 - shape.outside(p) / 8, 0.0, 1.0); });
  const ActiveCells active = allocate(density, Variant::Conservative);
  const std::vector<glm::dvec3> at = vertex_positions(density, active, placement);
  const std::vector<Quad> quads = quads_of(active);
  const std::vector<glm::dvec3> normals = vertex_normals(density, active, at, quads);
  Rank rank;
  for (std::size_t v = 0; v < at.size(); ++v) {
    if (!is_within(at[v])) continue;
    const glm::dvec3 n = gradient(shape, at[v]);
    rank.distance.add(std::abs(distance_to(shape, at[v], n)));
    rank.vertex_normal_deg.add(degrees_between(normals[v], n));
  }
  add_faces(shape, at, quads, rank);
  rank.nanoseconds = nanoseconds_of(density, active, placement);
  std::printf("| %s | `%s` | %zu | %.4f | %.4f | %.2f | %.1f | %.2f | %.1f | %.0f |\n", shape.name,
              name_of(placement), rank.distance.count, rank.distance.rms(), rank.distance.max,
              rank.face_normal_deg.rms(), rank.face_normal_deg.max, rank.vertex_normal_deg.rms(),
              rank.vertex_normal_deg.max, rank.nanoseconds);
  return rank;
}

std::map<Placement, Rank> ranks_of(const Shape& shape) {
  std::map<Placement, Rank> ranks;
  for (const Placement placement : {Placement::Mean, Placement::Qef, Placement::Particle})
    ranks[placement] = rank_of(shape, placement);
  return ranks;
}

// All crossings lie on it, and so does what is made of them: densities are rounded by 2^-25 at a
// slope of 1/8, so crossings by 2^-22 of a voxel; what qef does with them, twice that at most.
TEST(PlacementRanking, IsATieOnAPlane) {
  for (const auto& [placement, rank] : ranks_of(kPlane)) {
    EXPECT_LT(rank.distance.max, 0x1p-21) << name_of(placement);
    EXPECT_LT(rank.vertex_normal_deg.max, 0.01) << name_of(placement);
  }
}

// A mean of points of a convex surface lies within.
TEST(PlacementRanking, PutsMeansLastOnCurvedSolids) {
  for (const Shape* shape : {&kSphere, &kTorus}) {
    const auto ranks = ranks_of(*shape);
    EXPECT_LT(ranks.at(Placement::Qef).distance.rms(), ranks.at(Placement::Mean).distance.rms());
    EXPECT_LT(ranks.at(Placement::Particle).distance.rms(),
              ranks.at(Placement::Mean).distance.rms());
  }
}

// Qef and particle come nearer to the edges. But the slopes that they look at are differences of
// samples, which round an edge off over two voxels: faces there lie askew, some upside down, and
// turn farther from the truth than the mean's even bevel.
TEST(PlacementRanking, PutsMeansLastByDistanceAndFirstByFacesOnSharpEdges) {
  const auto ranks = ranks_of(kBox);
  const Rank& mean = ranks.at(Placement::Mean);
  for (const Placement placement : {Placement::Qef, Placement::Particle}) {
    EXPECT_LT(ranks.at(placement).distance.rms(), mean.distance.rms());
    EXPECT_GT(ranks.at(placement).face_normal_deg.rms(), mean.face_normal_deg.rms());
  }
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
