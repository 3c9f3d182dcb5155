// How far the surface moves from level to level, where stitching closes it all the same: by middle
// heights in place of means, and by a filter whose width is in voxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/camera.h"
#include "core/reproducible_math.h"
#include "reference/mesh_nearest.h"
#include "support/stack_surfaces.h"
#include "terrain/stacks/stack_pyramid.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::mesh::stacks {
namespace {

using terrain::StackField;
using test_support::filtered;
using test_support::surface_on;

using Height = std::function<double(double x, double y)>;

constexpr int kSide = 192, kLevels = 4;

double plane(double x, double y) { return 20.0 + 0.3 * x + 0.2 * y; }

// Waves of 64 m, 8 m high and deep; the steepest slope is 0.79, the largest twist
// A (2 pi / 64)^2 = 0.0771 a metre.
constexpr double kWave = 2 * kPi / 64, kAmplitude_m = 8.0;
double waves(double x, double y) {
  return 40.0 + kAmplitude_m * std::sin(kWave * x) * std::sin(kWave * y);
}

StackField ground(const Height& height) {
  return test_support::stacks_where(kSide, kSide, 128, [&](int i, int j) {
    return std::vector<terrain::Layer>{{0.0F, static_cast<float>(height(i, j)), 1}};
  });
}

struct Shift {
  double max_m = 0.0, squares = 0.0;
  int count = 0;

  void add(double off_m) {
    max_m = std::max(max_m, std::abs(off_m));
    squares += off_m * off_m;
    ++count;
  }
  double rms_m() const { return count == 0 ? 0.0 : std::sqrt(squares / count); }
};

// The stacks of a level, where they stand.
Shift of_middles(const StackField& level, const Height& height) {
  Shift shift;
  for (int j = 0; j < level.rows; ++j) {
    for (int i = 0; i < level.columns; ++i)
      shift.add(level.stack(i, j).end_m[0] -
                height(level.origin_m.x + i * level.dx_m, level.origin_m.y + j * level.dy_m));
  }
  return shift;
}

// What means of all heights would be.
Shift of_means(int level, const Height& height) {
  Shift shift;
  const int side = 1 << level;
  for (int j = 0; j + side <= kSide; j += side) {
    for (int i = 0; i + side <= kSide; i += side) {
      double sum = 0.0;
      for (int k = 0; k < side * side; ++k) sum += height(i + k % side, j + k / side);
      const double middle = 0.5 * (side - 1);
      shift.add(sum / (side * side) - height(i + middle, j + middle));
    }
  }
  return shift;
}

// The vertices of a surface drawn on one level, but near the rim, where the border goes on level.
Shift of_surface(const TriangleMesh& mesh, const Height& height) {
  Shift shift;
  for (const glm::dvec3& v : mesh.vertices_m) {
    constexpr double kMargin_m = 24.0;
    if (std::min({v.x, v.y, kSide - 1 - v.x, kSide - 1 - v.y}) > kMargin_m)
      shift.add(v.z - height(v.x, v.y));
  }
  return shift;
}

void print(const char* what, int level, const Shift& shift) {
  std::printf("%-28s level %d: %.3f m at most, %.3f rms\n", what, level, shift.max_m,
              shift.rms_m());
}

// Four heights of a plane: the middle two have its mean. A float's rounding each level.
TEST(StackShift, OfAPlaneIsThatOfCoverageAlone) {
  const auto levels = terrain::stack_pyramid(ground(plane), kLevels);
  const Prepared sharp = prepare(ground(plane), filtered(0));
  for (int level = 0; level < kLevels; ++level) {
    EXPECT_LT(of_middles(levels[static_cast<std::size_t>(level)], plane).max_m, 0x1p-15);
    // Slopes below 1: of the two ends of a crossing edge one at most is full or empty, and the
    // crossing is off by 3/2 - sqrt(2) voxels at most; a vertex is a mean of crossings.
    const Shift shift = of_surface(surface_on(sharp, level), plane);
    EXPECT_LE(shift.max_m, (1.5 - std::sqrt(2.0)) * (1 << level) + 0x1p-15);
    print("plane, unfiltered", level, shift);
  }
}

// The middle two of c +- a +- b +- d, d a quarter of the twist over the four, have the mean c - d
// where d is the smallest. Means move by curvature, middles by curvature and twist.
TEST(StackShift, OfWavesIsLargerByMiddlesThanByMeans) {
  const auto levels = terrain::stack_pyramid(ground(waves), kLevels);
  for (int level = 1; level < kLevels; ++level) {
    const Shift middles = of_middles(levels[static_cast<std::size_t>(level)], waves);
    const Shift means = of_means(level, waves);
    print("waves, middle heights", level, middles);
    print("waves, mean heights", level, means);
    EXPECT_GT(middles.rms_m(), means.rms_m());
  }
  // A quarter of the largest twist over a metre; that no middle lies just where it is largest, and
  // that sines bend within a metre, takes less than a hundredth each.
  const double quarter_m = kAmplitude_m * kWave * kWave / 4;
  EXPECT_NEAR(of_middles(levels[1], waves).max_m, quarter_m, 0.02 * quarter_m);
}

const char* name_of(const dual_contouring::Filter& filter) {
  return filter.kernel == dual_contouring::Kernel::Box ? "box" : "gauss";
}

// At a crest a low-pass of variance s^2 (voxels, along each axis) takes s^2 / 2 of both curvatures,
// so on level L 4^L times what it takes on level 0; Gauss of radius r has r / 2, box r (r + 1) / 3.
// Coverage adds its own, which doubles: together a little less than four times a level.
TEST(StackShift, OfAFilterGrowsNearlyFourfoldALevel) {
  for (const dual_contouring::Filter& filter :
       {dual_contouring::Filter{dual_contouring::Kernel::Gauss, 1},
        {dual_contouring::Kernel::Box, 1},
        {dual_contouring::Kernel::Gauss, 2}}) {
    Parameters parameters;
    parameters.filter = filter;
    const Prepared prepared = prepare(ground(waves), parameters);
    double before_m = 0.0;
    for (int level = 0; level < kLevels; ++level) {
      const Shift shift = of_surface(surface_on(prepared, level), waves);
      std::printf("%s of radius %d, ", name_of(filter), filter.radius);
      print("waves", level, shift);
      EXPECT_GT(shift.max_m, 3.0 * before_m);
      before_m = shift.max_m;
    }
  }
}

// From each vertex of a level to the surface of the next finer one: what a border between them
// hides, and what pops when a node is divided. All but a hundredth move by half a voxel of the
// coarser level at most, filtered or not.
TEST(StackShift, OfCavesIsHalfAVoxelALevel) {
  const StackField field = terrain::generate_stacks("generate:caves?size=193");
  for (const int radius : {0, 1, 2}) {
    const Prepared prepared = prepare(field, filtered(radius));
    TriangleMesh finer = surface_on(prepared, 0);
    for (int level = 1; level < kLevels; ++level) {
      const TriangleMesh coarser = surface_on(prepared, level);
      Shift shift;
      std::vector<double> all;
      for (const auto& found : reference::MeshNearest(finer).nearest(coarser.vertices_m)) {
        shift.add(found.distance_m);
        all.push_back(found.distance_m);
      }
      std::sort(all.begin(), all.end());
      const double p99_m = all[all.size() * 99 / 100];
      std::printf("radius %d, 99 in 100 within %.2f m, ", radius, p99_m);
      print("caves", level, shift);
      EXPECT_GT(p99_m, 0.2 * (1 << level));
      EXPECT_LT(p99_m, 0.6 * (1 << level));
      finer = coarser;
    }
  }
}

// The tolerance is the size of a node, not an error: what is drawn lies pixels beside the finest
// level. A cell spans tau / 16 pixels at most, and nothing was found farther off than one.
TEST(StackShift, OfAFrameIsPixelsAtThePapersTolerance) {
  const Prepared prepared =
      prepare(terrain::generate_stacks("generate:caves?size=257"), filtered(1, Variant::Published));
  const Camera camera =
      make_camera({.eye_m = {128, -60, 130}, .target_m = {128, 128, 40}, .fov_y_deg = 50});
  const DrawnSurface truth = finest(prepared);
  const reference::MeshNearest nearest(*truth.mesh);
  for (const double tau_px : {160.0, 320.0, 640.0}) {
    const DrawnSurface drawn = draw(prepared, camera, {tau_px, Unit::Pixel});
    std::vector<double> pixels;
    Shift shift;
    for (const auto& found : nearest.nearest(drawn.mesh->vertices_m)) {
      shift.add(found.distance_m);
      pixels.push_back(found.distance_m * camera.gamma_h /
                       glm::distance(camera.eye_m, found.point_m));
    }
    std::sort(pixels.begin(), pixels.end());
    const double p99_px = pixels[pixels.size() * 99 / 100];
    std::printf("| %.0f | %.1f | %zu | %.2f | %.2f | %.1f | %.1f |\n", tau_px, tau_px / 16,
                drawn.mesh->triangles.size(), shift.rms_m(), shift.max_m, p99_px, pixels.back());
    EXPECT_GT(pixels.back(), tau_px / 80);
    EXPECT_LT(pixels.back(), tau_px / 16);
  }
}

}  // namespace
}  // namespace plumb::mesh::stacks
