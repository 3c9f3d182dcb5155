// What each measurement of two full-HD pictures costs, on one core; a landscape drawn twice, the
// second time of every second sample.
#include "bench_support.h"
#include "compare/alignment.h"
#include "compare/comparison.h"
#include "compare/diagnosis.h"
#include "compare/local_difference.h"
#include "compare/plane_errors.h"
#include "compare/planted_defects.h"
#include "compare/planted_scene.h"
#include "compare/shift_match.h"
#include "compare/structural_similarity.h"

namespace plumb::bench {
namespace {

using compare::PicturePair;

constexpr double kPixels = 1920.0 * 1080.0;

const PicturePair& colours() {
  static const PicturePair kPair = [] {
    compare::PlantedSceneOptions options;
    options.width_px = 1920;
    options.height_px = 1080;
    const compare::PlantedScene scene(options);
    return PicturePair{"reference",
                       "candidate",
                       compare::colours_alone(scene.drawn()),
                       compare::colours_alone(scene.with_level_of_detail(2)),
                       {}};
  }();
  return kPair;
}

std::vector<std::span<const float>> planes_of(const image::PlaneImage& picture) {
  std::vector<std::span<const float>> planes;
  for (const image::Plane& plane : picture.planes) planes.emplace_back(plane.values);
  return planes;
}

void largest_rmse_psnr(benchmark::State& state) {
  measure(state, [] {
    for (std::size_t c = 0; c < 3; ++c) {
      benchmark::DoNotOptimize(compare::plane_errors(colours().reference.planes[c].values,
                                                     colours().candidate.planes[c].values)
                                   .psnr_db());
    }
  });
  set_rate(state, "Mpixel/s", kPixels);
}

void ssim(benchmark::State& state) {
  const Grid<float> a = compare::luma_of(colours().reference),
                    b = compare::luma_of(colours().candidate);
  measure(state, [&] { benchmark::DoNotOptimize(compare::structural_similarity(a, b)); });
  set_rate(state, "Mpixel/s", kPixels);
}

void local(benchmark::State& state) {
  const auto a = planes_of(colours().reference), b = planes_of(colours().candidate);
  measure(state, [&] { benchmark::DoNotOptimize(compare::local_difference(a, b, 1920, 1080)); });
  set_rate(state, "Mpixel/s", kPixels);
}

void shift_match(benchmark::State& state) {
  const auto a = planes_of(colours().reference), b = planes_of(colours().candidate);
  measure(state, [&] { benchmark::DoNotOptimize(compare::unmatched_pixels(a, b, 1920, 1080)); });
  set_rate(state, "Mpixel/s", kPixels);
}

void diagnosis(benchmark::State& state) {
  measure(state, [] {
    benchmark::DoNotOptimize(compare::diagnose(colours().reference, colours().candidate));
  });
  set_rate(state, "Mpixel/s", kPixels);
}

void everything(benchmark::State& state, bool all) {
  const compare::Profile profile = compare::built_in_profiles().front();
  measure(state, [&] {
    benchmark::DoNotOptimize(compare::compare_pictures(
        colours(), profile, {.most_listed = 20, .with_maps = false, .everything = all}));
  });
  set_rate(state, "Mpixel/s", kPixels);
}

void add_all() {
  add("largest_rmse_psnr", largest_rmse_psnr);
  add("ssim", ssim);
  add("local_difference", local);
  add("shift_match", shift_match);
  add("diagnosis", diagnosis);
  add("everything", everything, true);
  add("limits_only", everything, false);
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  plumb::bench::add_all();
  return plumb::bench::run(argc, argv);
}
