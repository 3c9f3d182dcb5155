// Where blocks and patches meet, and that a surface depends on nothing but its arguments.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/atomic_file.h"
#include "core/parallel.h"
#include "mesh/tessellation/block_levels.h"
#include "mesh/tessellation/view_test.h"
#include "support/run_command.h"
#include "support/tessellation_views.h"
#include "support/test_terrain.h"

namespace plumb::audit {
namespace {

using namespace mesh::tessellation;
using mesh::patch_quadtree::PatchLayout;
using mesh::patch_quadtree::PatchPlace;
using test_support::Random;
using test_support::rough_terrain;
using test_support::tessellation_with;
using test_support::View;

// What a frame decides, before it is drawn.
struct Decided {
  Decided(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance)
      : view{relative_to(camera, {prepared.header().origin_m, 0.0}), tolerance},
        selection(select_patches(prepared, view)),
        heights_m(decode_drawn(prepared, selection)),
        levels(choose_levels(prepared, view, selection, heights_m)) {}

  ViewTest view;
  PatchSelection selection;
  std::vector<Grid<float>> heights_m;
  ChosenLevels levels;
};

// A block of a frame by its place among all blocks of its level.
struct Seam {
  const Prepared& prepared;
  const Decided& decided;

  // Null where no patch of this level is drawn, or the block has no area or no height at all.
  const BlockLevels* block(int level, int x, int y) const {
    const PatchLayout& layout = prepared.header().layout;
    const int cells = prepared.pieces->block_cells(), blocks = layout.patch_cells / cells;
    if (x < 0 || y < 0) return nullptr;
    const PatchPlace place{level, x / blocks, y / blocks};
    if (!layout.contains(place)) return nullptr;
    const std::int32_t at = decided.selection.state[static_cast<std::size_t>(layout.index(place))];
    if (at < 0) return nullptr;
    const int i = x % blocks, j = y % blocks;
    if (layout.sample_column(place, i * cells) == layout.sample_column(place, (i + 1) * cells) ||
        layout.sample_row(place, j * cells) == layout.sample_row(place, (j + 1) * cells))
      return nullptr;
    bool some = false;
    for (int b = j * cells; b <= (j + 1) * cells; ++b)
      for (int a = i * cells; a <= (i + 1) * cells; ++a)
        some = some || !std::isnan(decided.heights_m[static_cast<std::size_t>(at)](a + 1, b + 1));
    return some ? &decided.levels.patches[static_cast<std::size_t>(at)].levels(i, j) : nullptr;
  }
};

// How many sides two blocks share.
int expect_agreement(const Prepared& prepared, const Decided& decided) {
  const Seam seam{prepared, decided};
  const PatchLayout& layout = prepared.header().layout;
  const int blocks = layout.patch_cells / prepared.pieces->block_cells();
  int shared = 0;
  for (int level = 0; level < layout.levels; ++level) {
    for (int y = 0; y < layout.patch_rows(level) * blocks; ++y) {
      for (int x = 0; x < layout.patch_columns(level) * blocks; ++x) {
        const BlockLevels* here = seam.block(level, x, y);
        if (here == nullptr) continue;
        for (const std::uint8_t side : here->side) EXPECT_LE(side, here->inside);
        const BlockLevels* east = seam.block(level, x + 1, y);
        const BlockLevels* north = seam.block(level, x, y + 1);
        if (north != nullptr) {
          EXPECT_EQ(here->side[North], north->side[South]);
        }
        if (east != nullptr) {
          EXPECT_EQ(here->side[East], east->side[West]);
          EXPECT_EQ(here->side[East], std::min(here->inside, east->inside));
        }
        shared += (east != nullptr) + (north != nullptr);
      }
    }
  }
  return shared;
}

TEST(TessellationSeams, BlocksOfOneLevelAgreeOnTheSideTheyShare) {
  Random random(51);
  int shared = 0;
  for (const double voids : {0.0, 0.01}) {
    for (const int block_cells : {8, 16}) {
      const terrain::Heightfield field = rough_terrain(190, 141, 4, 100.0, voids);
      const Prepared prepared = prepare(field, tessellation_with(0.05, 32, block_cells));
      for (int k = 0; k < 30; ++k) {
        const Camera camera = test_support::random_camera(
            random, field, static_cast<View>(k % static_cast<int>(View::Count)), 400, 300);
        const Tolerance tolerance{random.uniform(0.5, 20.0),
                                  k % 4 == 3 ? Unit::Metre : Unit::Pixel};
        shared += expect_agreement(prepared, Decided(prepared, camera, tolerance));
      }
    }
  }
  EXPECT_GT(shared, 10000);
}

Camera random_view_from_above(Random& random, const terrain::Heightfield& field) {
  const Box box = terrain::bounds(field);
  const auto across = [&](double low, double high) {
    return glm::dvec3{box.low.x + (box.high.x - box.low.x) * random.uniform(low, high),
                      box.low.y + (box.high.y - box.low.y) * random.uniform(low, high), 0.0};
  };
  LookAt look;
  look.eye_m = across(0.0, 1.0) + glm::dvec3{0.0, 0.0, box.high.z + random.uniform(5.0, 200.0)};
  look.target_m = across(0.1, 0.9);
  look.width_px = 320;
  look.height_px = 240;
  return make_camera(look);
}

DrawnSurface without_skirts(const DrawnSurface& surface) {
  DrawnSurface bare = surface;
  auto mesh = std::make_shared<TriangleMesh>(*surface.mesh);
  mesh->triangles.clear();
  bare.triangle_lod.clear();
  bare.patches.clear();
  for (const Patch& patch : surface.patches) {
    if (patch.kind != 0) continue;
    bare.patches.push_back(patch);
    bare.patches.back().first_triangle = static_cast<std::uint32_t>(mesh->triangles.size());
    for (std::uint32_t k = 0; k < patch.triangle_count; ++k) {
      mesh->triangles.push_back(surface.mesh->triangles[patch.first_triangle + k]);
      bare.triangle_lod.push_back(surface.triangle_lod[patch.first_triangle + k]);
    }
  }
  bare.mesh = mesh;
  bare.claims.clear();
  return bare;
}

// What is seen of skirts are cracks: few pixels, and none of them holes.
TEST(TessellationSeams, SkirtsHideEveryCrackAndLittleElse) {
  Random random(52);
  const terrain::Heightfield field = rough_terrain(257, 225, 6, 150.0);
  const HeightfieldTruth truth(field, terrain::Diagonal::Blocks8);
  const Prepared prepared = prepare(field, tessellation_with(0.05, 16));
  std::int64_t skirts = 0, pixels = 0, cracks = 0;
  for (int k = 0; k < 24; ++k) {
    const Camera camera = random_view_from_above(random, field);
    const Tolerance tolerance{random.uniform(1.0, 4.0), Unit::Pixel};
    const DrawnSurface surface = draw(prepared, camera, tolerance);
    AuditOptions options;
    options.nearest = false;
    options.band.pixels = tolerance.value;
    const AuditResult result = audit_surface(truth, surface, camera, options);
    EXPECT_EQ(result.coverage.defect_count(), 0) << k;
    EXPECT_TRUE(result.holds()) << k;
    const AuditResult bare = audit_surface(truth, without_skirts(surface), camera, options);
    for (std::size_t p = 0; p < result.drawn.size(); ++p) {
      if (!result.drawn.hit(p)) continue;
      ++pixels;
      const int patch = patch_of(surface, result.drawn.primitive[p]);
      if (surface.patches[static_cast<std::size_t>(patch)].kind == 0) continue;
      ++skirts;
      cracks += !bare.drawn.hit(p);
    }
  }
  std::printf("skirts: %lld of %lld pixels (%.3f %%), %lld of them empty without\n",
              static_cast<long long>(skirts), static_cast<long long>(pixels),
              100.0 * static_cast<double>(skirts) / static_cast<double>(pixels),
              static_cast<long long>(cracks));
  EXPECT_GT(cracks, 100);
  EXPECT_LT(skirts, pixels / 100);
}

void expect_same(const DrawnSurface& a, const DrawnSurface& b) {
  EXPECT_TRUE(a.mesh->vertices_m == b.mesh->vertices_m);
  EXPECT_TRUE(a.mesh->triangles == b.mesh->triangles);
  EXPECT_EQ(a.triangle_lod, b.triangle_lod);
  EXPECT_TRUE(a.claims == b.claims);
  EXPECT_EQ(a.notes, b.notes);
}

TEST(TessellationSeams, AFileGivesTheSurfaceOfTheMemory) {
  const testing::TemporaryFolder folder;
  Random random(53);
  const terrain::Heightfield field = rough_terrain(150, 131, 8, 100.0, 0.01);
  for (const std::uint32_t version : {1u, 2u}) {
    const Parameters parameters = tessellation_with(0.5, 32, 8, version);
    BuildOptions options;
    options.heights = {0.5, static_cast<mesh::patch_quadtree::CodecVersion>(version), 32};
    const auto bytes = build(field, options);
    const std::string path = folder.file("t.plumb");
    write_file_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    const Prepared from_file = prepare(field, path), from_memory = prepare(field, parameters);
    for (int k = 0; k < 4; ++k) {
      const Camera camera = random_view_from_above(random, field);
      expect_same(draw(from_file, camera, {2.0, Unit::Pixel}),
                  draw(from_memory, camera, {2.0, Unit::Pixel}));
    }
    const terrain::Heightfield other = rough_terrain(150, 131, 9);
    EXPECT_THROW(prepare(other, path), InputError);
  }
}

TEST(TessellationSeams, TheSurfaceHasTheSameBitsOnOneThread) {
  Random random(54);
  const terrain::Heightfield field = rough_terrain(200, 170, 10, 100.0, 0.01);
  for (const Variant variant : {Variant::Conservative, Variant::Published}) {
    Parameters parameters = tessellation_with(0.2, 16);
    parameters.variant = variant;
    const Prepared prepared = prepare(field, parameters);
    for (int k = 0; k < 4; ++k) {
      const Camera camera = random_view_from_above(random, field);
      const DrawnSurface two = draw(prepared, camera, {1.5, Unit::Pixel});
      const ThreadLimit limit(1);
      expect_same(draw(prepare(field, parameters), camera, {1.5, Unit::Pixel}), two);
    }
  }
}

}  // namespace
}  // namespace plumb::audit
