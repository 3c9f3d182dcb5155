// The promise of 0.01 px: a terrain of 160 km in UTM coordinates, seen from two metres above
// ground.
//
// A point computed from its ray projects to its own pixel whatever its depth, so the measure is
// |dP| * gamma / Z against an intersection in __float128; gamma is that of the default picture,
// 1920 pixels wide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "reference/embree_caster.h"
#include "reference/pyramid_caster.h"
#include "support/hit_image_difference.h"
#include "support/marching_caster.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using Wide = __float128;
using test_support::WideHit;
using test_support::WideRay;

constexpr int kSamples = 4097;
constexpr double kSpacing = 40.0;
constexpr double kBar = 0.01;  // px

// In [-1, 1), from the bits of a lattice point.
double lattice(int x, int y, unsigned octave) {
  unsigned h = static_cast<unsigned>(x) * 374761393u + static_cast<unsigned>(y) * 668265263u +
               octave * 2246822519u;
  h = (h ^ (h >> 13)) * 1274126177u;
  return static_cast<double>(h ^ (h >> 16)) * 0x1p-31 - 1.0;
}

// Value noise in octaves whose height is a fixed part of their width: as rough at every scale.
double fractal_height(int i, int j) {
  double z = 0.0;
  for (unsigned octave = 1; octave <= 11; ++octave) {
    const int width = 1 << octave;
    const auto ease = [](double s) { return s * s * (3.0 - 2.0 * s); };
    const double u = ease(static_cast<double>(i % width) / width);
    const double v = ease(static_cast<double>(j % width) / width);
    const int a = i / width, b = j / width;
    const double south = lattice(a, b, octave) * (1.0 - u) + lattice(a + 1, b, octave) * u;
    const double north = lattice(a, b + 1, octave) * (1.0 - u) + lattice(a + 1, b + 1, octave) * u;
    z += 1.8 * width * (south * (1.0 - v) + north * v);
  }
  return z;
}

Heightfield large_terrain() {
  Heightfield field;
  field.heights_m = Grid<float>(kSamples, kSamples);
  field.dx_m = field.dy_m = kSpacing;
  field.origin_m = {500123.4567, 4500765.4321};
  parallel_for(kSamples, 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < kSamples; ++i) {
      field.heights_m.floats()(i, j) = static_cast<float>(fractal_height(i, j));
    }
  });
  return field;
}

// Two metres above the ground of a grid line between samples i and i + 1 of row j, `part` of the
// way, looking to a point so many metres away.
Camera standing_at(const Heightfield& field, int i, int j, double part, const glm::dvec3& ahead,
                   int width_px, int height_px) {
  const double west = field.heights_m(i, j), east = field.heights_m(i + 1, j);
  LookAt look;
  look.eye_m = field.world_origin_m() +
               glm::dvec3{(i + part) * kSpacing, j * kSpacing, west + part * (east - west) + 2.0};
  look.target_m = look.eye_m + ahead;
  look.width_px = width_px;
  look.height_px = height_px;
  look.near_m = 0.01;
  return make_camera(look);
}

struct Viewpoint {
  const char* name;
  Camera camera;
};

std::vector<Viewpoint> viewpoints(const Heightfield& field, int width_px, int height_px) {
  constexpr int kMiddle = kSamples / 2, kLast = kSamples - 2;
  return {{"mid terrain",
           standing_at(field, kMiddle, kMiddle, 0.0, {300.0, 1000.0, -60.0}, width_px, height_px)},
          {"far corner", standing_at(field, kLast, kSamples - 1, 0.5, {-700.0, -900.0, -50.0},
                                     width_px, height_px)},
          {"odd digits",
           standing_at(field, 1237, 2893, 0.7236813, {911.3, -433.7, -77.1}, width_px, height_px)}};
}

// The cells around the one that was hit, in __float128.
WideHit<Wide> around(const Heightfield& field, Diagonal diagonal, const WideRay<Wide>& ray,
                     std::uint32_t triangle) {
  const int cell = static_cast<int>(triangle / 2);
  const int i = cell % field.cell_columns(), j = cell / field.cell_columns();
  WideHit<Wide> best;
  for (int b = std::max(j - 1, 0); b <= std::min(j + 1, field.cell_rows() - 1); ++b) {
    for (int a = std::max(i - 1, 0); a <= std::min(i + 1, field.cell_columns() - 1); ++a) {
      test_support::meet_wide_cell(ray, field, diagonal, a, b, best);
    }
  }
  return best;
}

struct Precision {
  double largest_px = 0.0;          // of sampled hits against their neighbourhood
  double largest_marched_px = 0.0;  // of sampled rays against the whole terrain
  std::size_t sampled = 0, marched = 0, wrong_hit_or_miss = 0;
};

// Samples every `stride`-th pixel, and of these marches every `march`-th through the whole terrain.
Precision precision_of(const HitImage& image, const Heightfield& field, Diagonal diagonal,
                       const Camera& camera, std::size_t stride, std::size_t march) {
  const double gamma = camera.gamma_v * 1080.0 / camera.height_px;
  const test_support::MarchingCaster<Wide> marcher(field, diagonal);
  const std::size_t count = image.size() / stride;
  std::vector<Precision> of(count);
  parallel_for(static_cast<std::int64_t>(count), 8, [&](std::int64_t k) {
    const std::size_t pixel = static_cast<std::size_t>(k) * stride;
    Precision& found = of[static_cast<std::size_t>(k)];
    const glm::dvec3 direction =
        ray_direction(camera, static_cast<double>(pixel % camera.width_px) + 0.5,
                      static_cast<double>(pixel / camera.width_px) + 0.5);
    const auto ray = test_support::wide_ray<Wide>(camera.eye_m, field.world_origin_m(), direction,
                                                  camera.near_m, camera.far_m);
    const auto apart_px = [&](const WideHit<Wide>& truth) {
      const double along = static_cast<double>(Wide(image.depth_m[pixel]) - truth.t);
      return std::abs(along) * glm::length(direction) * gamma / static_cast<double>(truth.t);
    };
    ++found.sampled;
    if (image.hit(pixel)) {
      const auto truth = around(field, diagonal, ray, image.primitive[pixel]);
      found.wrong_hit_or_miss += !truth.hit;
      if (truth.hit) found.largest_px = apart_px(truth);
    }
    if (static_cast<std::size_t>(k) % march == 0) {
      const auto truth = marcher.cast(ray);
      ++found.marched;
      found.wrong_hit_or_miss += truth.hit != image.hit(pixel);
      if (truth.hit && image.hit(pixel)) found.largest_marched_px = apart_px(truth);
    }
  });
  Precision sum;
  for (const Precision& one : of) {
    sum.largest_px = std::max(sum.largest_px, one.largest_px);
    sum.largest_marched_px = std::max(sum.largest_marched_px, one.largest_marched_px);
    sum.sampled += one.sampled;
    sum.marched += one.marched;
    sum.wrong_hit_or_miss += one.wrong_hit_or_miss;
  }
  return sum;
}

void expect_within_bar(const Precision& found, const std::string& name) {
  std::printf(
      "%s: %zu rays, at most %.3g px; %zu marched, at most %.3g px, %zu wrong hits or misses\n",
      name.c_str(), found.sampled, found.largest_px, found.marched, found.largest_marched_px,
      found.wrong_hit_or_miss);
  EXPECT_EQ(found.wrong_hit_or_miss, 0u) << name;
  EXPECT_LE(found.largest_px, kBar) << name;
  EXPECT_LE(found.largest_marched_px, kBar) << name;
}

void expect_precision(int width_px, int height_px, std::size_t stride, std::size_t march) {
  const Heightfield field = large_terrain();
  const Diagonal diagonal = Diagonal::Alternating;
  const EmbreeCaster embree(field, diagonal);
  const PyramidCaster pyramid(field, diagonal);
  for (const Viewpoint& view : viewpoints(field, width_px, height_px)) {
    const HitImage by_embree = embree.cast_frame(view.camera);
    const HitImage by_pyramid = pyramid.cast_frame(view.camera);
    const auto d = test_support::difference(view.camera, by_embree, by_pyramid);
    EXPECT_GT(d.hits, d.pixels / 4) << view.name;
    EXPECT_EQ(d.hit_or_miss + d.elsewhere, 0u) << view.name << ": " << to_text(d);
    expect_within_bar(precision_of(by_embree, field, diagonal, view.camera, stride, march),
                      std::string("embree, ") + view.name);
    expect_within_bar(precision_of(by_pyramid, field, diagonal, view.camera, stride, march),
                      std::string("pyramid, ") + view.name);
  }
}

TEST(Precision, IsWithinAHundredthOfAPixelOn160Kilometres) { expect_precision(480, 270, 31, 16); }

TEST(LongPrecision, IsWithinAHundredthOfAPixelOn160Kilometres) {
  expect_precision(1920, 1080, 17, 16);
}

}  // namespace
}  // namespace plumb::reference
