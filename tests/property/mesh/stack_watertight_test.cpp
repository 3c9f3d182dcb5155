// Random octrees over caves: surfaces without cracks, by their edges and by rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "mesh/stacks/stack_densities.h"
#include "reference/embree_caster.h"
#include "support/face_checks.h"
#include "support/octree_surfaces.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::mesh::stacks {
namespace {

using dual_contouring::Filter;
using dual_contouring::Kernel;
using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

// A terrain of caves whose densities are worked out once for each box.
class Caves {
 public:
  Caves(const std::string& parameters, const Filter& filter)
      : densities_(terrain::generate_stacks("generate:caves?" + parameters), filter) {}

  const StackDensities& densities() const { return densities_; }
  glm::ivec3 size() const { return densities_.size(); }
  DensitySource source() {
    return [this](int level, const LatticeBox& box) -> Lattice<float> {
      const glm::ivec3 &low = box.low, &size = box.size;
      const Key key{level, low.x, low.y, low.z, size.x, size.y, size.z};
      const auto known = known_.find(key);
      if (known != known_.end()) return known->second;
      return known_.emplace(key, densities_(level, box)).first->second;
    };
  }

 private:
  using Key = std::tuple<int, int, int, int, int, int, int>;

  StackDensities densities_;
  std::map<Key, Lattice<float>> known_;
};

// Whole nodes and odd sizes, holes, caves from none to wide, filters.
std::vector<std::unique_ptr<Caves>> all_caves() {
  std::vector<std::unique_ptr<Caves>> caves;
  const auto add = [&](const char* parameters, const Filter& filter) {
    caves.push_back(std::make_unique<Caves>(parameters, filter));
  };
  add("size=96&relief=64&feature=120&seed=1", {});
  add("size=93x85&relief=50&feature=100&seed=2&caves=2", {});
  add("size=70x99&relief=64&feature=90&seed=3&caves=1.5&voids=0.05", {Kernel::Gauss, 2});
  add("size=81x65&relief=80&feature=80&seed=4&caves=3", {Kernel::Box, 0});
  return caves;
}

// -1 and 1: a vertex on the low or the high rim of an axis, 0: within.
int rim_of(const VertexName& name, int axis, const glm::ivec3& size) {
  const int samples = (size[axis] + (1 << name.level) - 1) >> name.level;
  return name.cell[axis] < 0 ? -1 : name.cell[axis] + 1 >= samples ? 1 : 0;
}

testing::FaceCheck check(const JoinedSurface& surface, const glm::ivec3& size) {
  return testing::check_faces(surface.faces, [&](std::uint32_t a, std::uint32_t b) {
    for (int axis = 0; axis < 2; ++axis) {
      const int rim = rim_of(surface.names[a], axis, size);
      if (rim != 0 && rim == rim_of(surface.names[b], axis, size)) return true;
    }
    return false;
  });
}

bool is_of_two_levels(const JoinedSurface& surface, const Face& face) {
  for (const std::uint32_t corner : face) {
    if (corner != kNoCorner && surface.names[corner].level != surface.names[face[0]].level)
      return true;
  }
  return false;
}

// What a tree counts for: places where the surface passes from one level to another.
int faces_between_levels(const JoinedSurface& surface) {
  return static_cast<int>(std::count_if(surface.faces.begin(), surface.faces.end(),
                                        [&](auto& f) { return is_of_two_levels(surface, f); }));
}

// A tree over one of the terrains.
struct Drawn {
  std::uint64_t seed = 0;
  const Caves* caves = nullptr;
  JoinedSurface surface;
};

// Calls visit(drawn) for as many trees as there are to be, all of which have faces between levels.
template <class Visit>
void for_each_tree(int trees, Variant variant, const Visit& visit) {
  const auto caves = all_caves();
  int counted = 0;
  for (std::uint64_t seed = 1; counted < trees; ++seed) {
    ASSERT_LT(seed, 2U * trees + 20) << "only " << counted << " trees count";
    Caves& terrain = *caves[seed % caves.size()];
    const Octree octree =
        testing::random_octree(terrain.size(), seed, 2 + static_cast<int>(seed / 4 % 3));
    ASSERT_TRUE(octree.is_balanced());
    Drawn drawn{seed, &terrain, {}};
    drawn.surface = testing::surface_of(
        octree, terrain.source(), {variant, dual_contouring::Placement::Mean, terrain.size()});
    if (faces_between_levels(drawn.surface) == 0) continue;
    ++counted;
    SCOPED_TRACE(seed);
    visit(drawn);
  }
}

void expect_watertight(int trees) {
  for_each_tree(trees, Variant::Conservative, [](const Drawn& drawn) {
    const testing::FaceCheck faces = check(drawn.surface, drawn.caves->size());
    EXPECT_EQ(faces.odd_edges, 0);
    EXPECT_EQ(faces.crowded_edges, 0);
    EXPECT_EQ(faces.torn_vertices, 0);
    EXPECT_GT(faces.rim_edges, 0);
  });
}

TEST(StackWatertight, HasTwoFacesAtEveryEdge) { expect_watertight(40); }
TEST(LongStackWatertight, HasTwoFacesAtEveryEdgeOfAThousandTrees) { expect_watertight(1000); }

TEST(StackWatertight, IsClosedAsPublished) {
  for_each_tree(12, Variant::Published, [](const Drawn& drawn) {
    EXPECT_TRUE(check(drawn.surface, drawn.caves->size()).is_closed());
  });
}

TEST(StackWatertight, EndsAtTheOutermostStacks) {
  for_each_tree(8, Variant::Conservative, [](const Drawn& drawn) {
    const glm::ivec3 size = drawn.caves->size();
    for (std::size_t k = 0; k < drawn.surface.names.size(); ++k) {
      for (int axis = 0; axis < 2; ++axis) {
        const int rim = rim_of(drawn.surface.names[k], axis, size);
        const double place = drawn.surface.position[k][axis];
        EXPECT_GE(place, 0.5);
        EXPECT_LE(place, size[axis] - 0.5);
        EXPECT_TRUE(rim == 0 || place == (rim < 0 ? 0.5 : size[axis] - 0.5)) << place;
      }
    }
  });
}

TriangleMesh triangles_of(const JoinedSurface& surface) {
  TriangleMesh mesh;
  mesh.vertices_m = surface.position;
  for (const Face& face : surface.faces) {
    mesh.triangles.push_back({face[0], face[1], face[2]});
    if (face[3] != kNoCorner) mesh.triangles.push_back({face[0], face[2], face[3]});
  }
  return mesh;
}

// Rays through places, from above all ground to below it, which stay within the rims. The surface
// parts what is below from what is above, so that each of them meets it.
class Rays {
 public:
  explicit Rays(const glm::ivec3& size) : size_(size) {}

  void add_through(const glm::dvec3& place) {
    for (const glm::dvec3& up : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.45, 0.1, 1.0),
                                 glm::dvec3(-0.2, 0.6, 1.0), glm::dvec3(0.9, -0.8, 1.0)}) {
      const glm::dvec3 top = place + up * (size_.z + 64.0 - place.z);
      const glm::dvec3 bottom = place + up * (-64.0 - place.z);
      if (!is_within(top) || !is_within(bottom)) continue;
      rays.push_back({top, bottom - top, 0.0, 1.0});
      rays.push_back({bottom, top - bottom, 0.0, 1.0});
    }
  }

  std::vector<reference::Ray> rays;

 private:
  bool is_within(const glm::dvec3& p) const {
    return p.x > 0.5 && p.y > 0.5 && p.x < size_.x - 0.5 && p.y < size_.y - 0.5;
  }

  glm::ivec3 size_;
};

// Where cracks would be: on and beside the edges of faces between two levels, and in these.
void add_borders(const JoinedSurface& surface, Rays& rays) {
  for (const Face& face : surface.faces) {
    if (!is_of_two_levels(surface, face)) continue;
    const std::size_t corners = face[3] == kNoCorner ? 3 : 4;
    glm::dvec3 middle(0.0);
    for (std::size_t k = 0; k < corners; ++k) {
      const glm::dvec3& a = surface.position[face[k]];
      const glm::dvec3& b = surface.position[face[(k + 1) % corners]];
      middle += a / static_cast<double>(corners);
      for (const double t : {0.0, 0.15, 0.5, 0.8}) {
        for (const double aside : {0.0, 3e-3, -3e-3})
          rays.add_through(a + t * (b - a) + glm::dvec3(aside, -aside, 0.0));
      }
    }
    rays.add_through(middle);
  }
}

// Rays that pass `cracked`, of those through the borders of levels of `surface`, and of a grid.
struct Passed {
  std::size_t cast = 0;
  int passed = 0;
};
Passed cast_at(const JoinedSurface& cracked, const JoinedSurface& surface, const glm::ivec3& size) {
  Rays rays(size);
  add_borders(surface, rays);
  for (double y = 1.0; y < size.y; y += 1.37)
    for (double x = 1.0; x < size.x; x += 1.37) rays.add_through({x, y, size.z * 0.5});
  const TriangleMesh mesh = triangles_of(cracked);
  const reference::EmbreeCaster caster(mesh);
  Passed result{rays.rays.size(), 0};
  for (const reference::RayHit& hit : caster.cast(rays.rays)) result.passed += hit ? 0 : 1;
  return result;
}

TEST(StackWatertight, LetsNoRayThrough) {
  std::size_t cast = 0;
  for_each_tree(8, Variant::Conservative, [&](const Drawn& drawn) {
    const Passed rays = cast_at(drawn.surface, drawn.surface, drawn.caves->size());
    EXPECT_EQ(rays.passed, 0) << "of " << rays.cast;
    cast += rays.cast;
  });
  EXPECT_GT(cast, 100000U);
}

// Faces between levels are torn off those beside them and moved by a hundredth of a voxel.
JoinedSurface with_cracks(JoinedSurface surface) {
  for (Face& face : surface.faces) {
    if (!is_of_two_levels(surface, face)) continue;
    for (std::uint32_t& corner : face) {
      if (corner == kNoCorner) continue;
      surface.names.push_back(surface.names[corner]);
      const glm::dvec3 moved = surface.position[corner] + glm::dvec3(0.01, 0.0, 0.0);
      surface.position.push_back(moved);
      corner = static_cast<std::uint32_t>(surface.position.size() - 1);
    }
  }
  return surface;
}

TEST(StackWatertight, WouldLetRaysThroughNarrowCracks) {
  int passed = 0;
  for_each_tree(4, Variant::Conservative, [&](const Drawn& drawn) {
    passed += cast_at(with_cracks(drawn.surface), drawn.surface, drawn.caves->size()).passed;
  });
  EXPECT_GT(passed, 0);
}

}  // namespace
}  // namespace plumb::mesh::stacks
