// Meshes of dual contouring on solids of all kinds: closed, manifold, outwards, in place.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/reproducible_math.h"
#include "mesh/dual_contouring/quadrangulate.h"
#include "mesh/dual_contouring/smoothing.h"
#include "support/quad_mesh_checks.h"
#include "support/slow_contour.h"
#include "support/test_lattices.h"

namespace plumb::mesh::dual_contouring {
namespace {

using testing::check_quads;
using testing::QuadMeshCheck;

double length(const glm::dvec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

// Signed distance outwards -> density, linear for two units on both sides.
double density_at(double outside) { return std::clamp(0.5 - outside / 4, 0.0, 1.0); }

constexpr double kRadius = 10.0;

Lattice<float> sphere() {
  const glm::dvec3 centre(0.3, -0.2, 0.1);
  return testing::sampled_lattice({glm::ivec3(-14), glm::ivec3(29)}, [&](const glm::dvec3& p) {
    return density_at(length(p - centre) - kRadius);
  });
}

Lattice<float> torus() {
  return testing::sampled_lattice({glm::ivec3(-16), glm::ivec3(33)}, [](const glm::dvec3& p) {
    const double from_axis = std::sqrt(p.x * p.x + p.y * p.y) - 9.1;
    return density_at(std::sqrt(from_axis * from_axis + p.z * p.z) - 4.2);
  });
}

// Random signs, air outside.
Lattice<float> random_signs(std::uint64_t seed) {
  const Lattice<float> inner = testing::random_lattice({{}, glm::ivec3(16)}, seed);
  Lattice<float> density(inner.box().grown(1));
  for (std::size_t k = 0; k < inner.values().size(); ++k)
    density(inner.box().at(k)) = inner.values()[k];
  return density;
}

// Noise that a wide filter has smoothed, air outside.
Lattice<float> smooth_noise(std::uint64_t seed) {
  Lattice<float> noise = testing::random_lattice({{}, glm::ivec3(64)}, seed);
  const Lattice<float> smooth = smoothed(smoothed(noise, {Kernel::Gauss, 4}), {Kernel::Gauss, 2});
  Lattice<float> density(smooth.box().grown(1));
  for (std::size_t k = 0; k < smooth.values().size(); ++k)
    density(smooth.box().at(k)) = smooth.values()[k];
  return density;
}

const Options kAllOptions[] = {
    {Variant::Published, Placement::Mean},     {Variant::Published, Placement::Qef},
    {Variant::Published, Placement::Particle}, {Variant::Conservative, Placement::Mean},
    {Variant::Conservative, Placement::Qef},   {Variant::Conservative, Placement::Particle}};

TEST(DualContouring, DrawsASphereAsASphere) {
  for (const Options& options : kAllOptions) {
    const QuadMeshCheck check = check_quads(quadrangulate(sphere(), options));
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.unused_vertices, 0);
    EXPECT_EQ(check.euler, 2);
  }
}

TEST(DualContouring, DrawsATorusAsATorus) {
  for (const Options& options : kAllOptions) {
    const QuadMeshCheck check = check_quads(quadrangulate(torus(), options));
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.euler, 0);
  }
}

// Along an edge the distance to the centre is convex with a second derivative of at most 1 / (R -
// 1), so a crossing lies inside the sphere by e = 1 / (8 (R - 1)) at most. A mean of points of a
// unit cube is nearer to the centre than their distances: |m|^2 = mean |p|^2 - variance, which is
// 3/4 at most. Densities are floats: 2^-24 over the slope, 1/4.
constexpr double kFloat = 0x1p-22;
double least_distance() {
  const double crossing = kRadius - 1 / (8 * (kRadius - 1)) - kFloat;
  return std::sqrt(crossing * crossing - 0.75);
}

TEST(DualContouring, PutsMeansOnTheSphere) {
  const glm::dvec3 centre(0.3, -0.2, 0.1);
  for (const glm::dvec3& at : quadrangulate(sphere()).position) {
    EXPECT_LE(length(at - centre), kRadius + kFloat);
    EXPECT_GE(length(at - centre), least_distance());
  }
}

// A triangle's points are nearer than its corners by no more than L^2 / 3 of their squares; the
// cells p - a - b and p span 2 x 2 x 1, so L <= 3.
TEST(DualContouring, EnclosesTheSphereFromInside) {
  const double nearest = std::sqrt(least_distance() * least_distance() - 3.0);
  const double volume = check_quads(quadrangulate(sphere())).volume;
  EXPECT_LT(volume, 4.0 / 3 * kPi * kRadius * kRadius * kRadius);
  EXPECT_GT(volume, 4.0 / 3 * kPi * nearest * nearest * nearest);
}

// The distance to a torus of radii R and r bends by at most k = 1 / (r - s) or 1 / (R - r - s) per
// unit, s = sqrt(3) away from it: its second derivatives. A crossing is k / 8 off, a mean of them k
// / 2 times their variance more, 3/4 at most.
TEST(DualContouring, PutsMeansOnTheTorus) {
  const double bend = 1 / (4.2 - std::sqrt(3.0));
  ASSERT_GT(bend, 1 / (9.1 - 4.2 - std::sqrt(3.0)));
  for (const glm::dvec3& at : quadrangulate(torus()).position) {
    const double from_axis = std::sqrt(at.x * at.x + at.y * at.y) - 9.1;
    const double off = std::sqrt(from_axis * from_axis + at.z * at.z) - 4.2;
    EXPECT_LT(std::abs(off), bend / 8 + bend / 2 * 0.75 + kFloat);
  }
}

// Means lie inside by the sphere's bend; planes through the crossings touch it outside.
TEST(DualContouring, PutsLeastSquaresNearerToTheSphereThanMeans) {
  const auto worst = [](Placement placement) {
    double off = 0.0;
    for (const glm::dvec3& at :
         quadrangulate(sphere(), {Variant::Conservative, placement}).position)
      off = std::max(off, std::abs(length(at - glm::dvec3(0.3, -0.2, 0.1)) - kRadius));
    return off;
  };
  EXPECT_LT(worst(Placement::Qef), worst(Placement::Mean));
}

struct Torn {
  int vertices = 0, torn = 0, crowded = 0, odd = 0;

  void add(const QuadMesh& mesh) {
    const QuadMeshCheck check = check_quads(mesh);
    vertices += static_cast<int>(mesh.position.size());
    torn += check.torn_vertices;
    crowded += check.crowded_edges;
    odd += check.odd_edges;
  }
};

TEST(DualContouring, IsAManifoldOnRandomSigns) {
  Torn sum;
  for (std::uint64_t seed = 0; seed < 40; ++seed) sum.add(quadrangulate(random_signs(seed)));
  EXPECT_EQ(sum.torn, 0);
  EXPECT_EQ(sum.crowded, 0);
  EXPECT_EQ(sum.odd, 0);
}

// Blocks of eight voxels a side that draw the edges from their own, as nodes of an octree do, with
// two samples more on every side: put together by place, they are the mesh of the whole.
TEST(DualContouring, IsTheSameInBlocks) {
  for (const Placement placement : {Placement::Mean, Placement::Qef}) {
    const Options options{Variant::Conservative, placement};
    const Lattice<float> inner = random_signs(5);
    Lattice<float> density(inner.box().grown(2));
    for (std::size_t k = 0; k < inner.values().size(); ++k)
      density(inner.box().at(k)) = inner.values()[k];
    using Corners = std::array<std::array<double, 3>, 4>;
    std::multiset<Corners> whole, blocks;
    const auto put = [](const QuadMesh& mesh, std::multiset<Corners>& quads) {
      for (const Quad& quad : mesh.quads) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
          const glm::dvec3& at = mesh.position[quad[k]];
          corners[k] = {at.x, at.y, at.z};
        }
        quads.insert(corners);
      }
    };
    put(quadrangulate(density, options), whole);
    for (int block = 0; block < 27; ++block) {
      const glm::ivec3 first = glm::ivec3(block % 3, block / 3 % 3, block / 9) * 8 - 1;
      Lattice<float> part({first - 2, glm::ivec3(12)});
      for (std::size_t k = 0; k < part.values().size(); ++k) {
        const glm::ivec3 at = part.box().at(k);
        part.values()[k] = density.box().contains(at) ? density(at) : 0.0F;
      }
      put(quadrangulate(part, options, {first, glm::ivec3(8)}), blocks);
    }
    EXPECT_GT(whole.size(), 1000u);
    EXPECT_TRUE(whole == blocks);
  }
}

// What the splits are for.
TEST(DualContouring, WouldNotBeAManifoldWithoutSplits) {
  Torn sum;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Lattice<float> density = random_signs(seed);
    sum.add(testing::SlowContour(density, {}, false).mesh());
  }
  EXPECT_GT(sum.crowded, 0);
  EXPECT_EQ(sum.odd, 0);
}

TEST(DualContouring, IsClosedButTornAsPublished) {
  Torn random, smooth;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    random.add(quadrangulate(random_signs(seed), {Variant::Published, Placement::Mean}));
  for (std::uint64_t seed = 0; seed < 3; ++seed)
    smooth.add(quadrangulate(smooth_noise(seed), {Variant::Published, Placement::Mean}));
  EXPECT_EQ(random.odd + smooth.odd, 0);
  RecordProperty("random_torn", random.torn);
  RecordProperty("random_vertices", random.vertices);
  RecordProperty("smooth_torn", smooth.torn);
  RecordProperty("smooth_vertices", smooth.vertices);
  EXPECT_NEAR(static_cast<double>(random.torn) / random.vertices, 0.40, 0.05);
  EXPECT_NEAR(static_cast<double>(smooth.torn) / smooth.vertices, 0.01, 0.008);
}

TEST(DualContouring, IsAManifoldOnSmoothNoise) {
  Torn sum;
  for (std::uint64_t seed = 0; seed < 3; ++seed) sum.add(quadrangulate(smooth_noise(seed)));
  EXPECT_GT(sum.vertices, 10000);
  EXPECT_EQ(sum.torn + sum.crowded + sum.odd, 0);
}

TEST(DualContouring, TurnsFacesOutwards) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Lattice<float> density = random_signs(seed);
    for (const Options& options : kAllOptions)
      EXPECT_GT(check_quads(quadrangulate(density, options)).volume, 0.0);
  }
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
