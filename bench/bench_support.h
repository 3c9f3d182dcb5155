// What the benches share: user time of the process, terrains and views.
#pragma once

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdlib>
#include <string>

#include "core/camera.h"
#include "core/parallel.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::bench {

/// Seconds that this process has computed for, in user mode, on all its threads.
inline double user_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// The terrain that PLUMB_BENCH_TERRAIN names, a file or a generator; PLUMB_BENCH_DECODE, _SPACING
/// and _WINDOW stand for the command's options.
inline const terrain::Heightfield& bench_terrain() {
  static const terrain::Heightfield field = [] {
    const char* named = std::getenv("PLUMB_BENCH_TERRAIN");
    terrain::ReadOptions options;
    if (const char* decode = std::getenv("PLUMB_BENCH_DECODE"))
      options.decode = terrain::parse_decode(decode);
    if (const char* spacing = std::getenv("PLUMB_BENCH_SPACING"))
      options.spacing_x_m = options.spacing_y_m = std::atof(spacing);
    if (const char* window = std::getenv("PLUMB_BENCH_WINDOW"))
      options.window = terrain::parse_window(window);
    return terrain::load_terrain(named ? named : "generate:alpine?size=4097", options);
  }();
  return field;
}

inline Camera bench_camera(const char* preset, int width_px = 1920, int height_px = 1080) {
  return make_camera(terrain::preset_camera(bench_terrain(), preset, width_px, height_px, 50.0));
}

inline double triangles_of(const terrain::Heightfield& field) {
  return 2.0 * field.cell_columns() * field.cell_rows();
}

/// Runs work() again and again on one thread; iteration time is user time, wall time beside it.
template <class Work>
void measure(benchmark::State& state, const Work& work) {
  const ThreadLimit one(1);
  double wall = 0.0;
  for (auto _ : state) {
    const auto begun = std::chrono::steady_clock::now();
    const double before = user_seconds();
    work();
    state.SetIterationTime(user_seconds() - before);
    wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  }
  state.counters["wall_s"] = benchmark::Counter(wall, benchmark::Counter::kAvgIterations);
}

/// `count` things an iteration: millions a second of user time.
inline void set_rate(benchmark::State& state, const char* name, double count) {
  state.counters[name] =
      benchmark::Counter(1e-6 * count, benchmark::Counter::kIsIterationInvariantRate);
}

inline constexpr const char* kPresets[] = {"oblique", "top", "valley", "grazing"};

/// Registers function(state, arguments...) under a name, timed as `measure` says.
template <class Function, class... Arguments>
void add(const std::string& name, Function function, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) { function(state, arguments...); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->MinTime(1.0);
}

/// Runs what was added; the exit status.
inline int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace plumb::bench
