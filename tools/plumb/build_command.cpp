// plumb build: a terrain as a file that a method draws from.
#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "buildable.h"
#include "command.h"
#include "common_options.h"
#include "container_info.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "core/claim.h"
#include "core/parallel.h"
#include "mesh/patch_quadtree/decoded_check.h"
#include "progress.h"
#include "stack_build.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;
namespace patches = mesh::patch_quadtree;

struct BuildOptions {
  TerrainOptions terrain;
  std::string method = "tessellation", error, output;
  int format_version = 2, patch_cells = 128, threads = 0;
  bool json = false;
  StackBuildOptions stacks;
};

double error_m(const std::string& text) {
  if (text.empty())
    input_error("--error is required: how far off a decoded height may be, such as 1m");
  const Tolerance error = parse_tolerance(text, "--error");
  if (error.unit != Unit::Metre)
    input_error("--error '{}': a file serves every view, so its error is in metres, such as 1m",
                text);
  if (!(error.value > 0.0)) input_error("--error '{}': expected more than 0m", text);
  return error.value;
}

patches::EncodeOptions encode_options(const BuildOptions& options) {
  patches::EncodeOptions encode;
  encode.error_m = error_m(options.error);
  encode.version = static_cast<patches::CodecVersion>(options.format_version);
  encode.patch_cells = options.patch_cells;
  return encode;
}

void check_output(const BuildOptions& options) {
  if (options.output.empty()) input_error("build needs -o: the file to write, such as t.plumb");
  if (options.output == "-")
    input_error("-o -: the file is read again before it counts as written, so it needs a name");
  std::error_code ignored;
  if (fs::equivalent(options.output, options.terrain.terrain, ignored))
    input_error("-o '{}' is the terrain itself", options.output);
}

void write(const fs::path& path, const Bytes& bytes, const std::string& named) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
    input_error("cannot write '{}': {}", named,
                errno != 0 ? std::strerror(errno) : "writing failed");
}

// What was built, and found when it was read again.
struct Built {
  std::int64_t bytes = 0, raw_bytes = 0, samples = 0, patches = 0, voids = 0;
  double error_m = 0.0, bits_per_sample = 0.0, ratio_to_16_bits = 0.0;
  std::vector<patches::DecodedLevel> levels;
  double read_s = 0.0, encode_s = 0.0, check_s = 0.0;

  double ratio_to_raw() const {
    return static_cast<double>(raw_bytes) / static_cast<double>(bytes);
  }
  double megasamples_per_s(double seconds) const {
    return seconds > 0.0 ? 1e-6 * static_cast<double>(samples) / seconds : 0.0;
  }
};

double seconds_since(std::chrono::steady_clock::time_point& begin) {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> taken = now - begin;
  begin = now;
  return taken.count();
}

std::int64_t voids_of(const terrain::Heightfield& field) {
  return parallel_ordered_reduce(
      field.rows(), 64, std::int64_t{0},
      [&](std::int64_t begin, std::int64_t end, std::int64_t count) {
        for (auto j = static_cast<int>(begin); j < static_cast<int>(end); ++j)
          for (int i = 0; i < field.columns(); ++i) count += field.is_void(i, j) ? 1 : 0;
        return count;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
}

Built build(const BuildOptions& options, Progress& progress) {
  const Buildable method = buildable(options.method);
  const patches::EncodeOptions encode = encode_options(options);
  TemporarySibling sibling(options.output);
  auto begin = std::chrono::steady_clock::now();
  Built built;
  progress.step("reading the terrain");
  const terrain::Heightfield field = load(options.terrain);
  built.samples = static_cast<std::int64_t>(field.heights_m.size());
  built.raw_bytes = field.heights_m.bytes();
  built.voids = voids_of(field);
  if (built.voids == built.samples)
    input_error("{}: every sample is void, there is nothing to build", options.terrain.terrain);
  built.read_s = seconds_since(begin);
  progress.step("coding its patches");
  write(sibling.path(), method.file(field, encode), options.output);
  built.encode_s = seconds_since(begin);
  progress.step("decoding and comparing every one");
  const patches::Container container(sibling.path());
  built.levels = patches::check_decoded(container, field);
  patches::require_holds(built.levels);
  built.check_s = seconds_since(begin);
  built.bytes = container.file_bytes();
  built.patches = container.header().layout.patch_count();
  built.error_m = container.header().error_m;
  built.bits_per_sample = bits_per_sample(container);
  built.ratio_to_16_bits = ratio_to_16_bits(container);
  sibling.commit();
  return built;
}

std::string build_text(const BuildOptions& options, const Built& built) {
  std::vector<std::vector<std::string>> levels;
  for (std::size_t level = 0; level < built.levels.size(); ++level) {
    const patches::DecodedLevel& of = built.levels[level];
    levels.push_back({std::to_string(level), std::to_string(of.patches),
                      fmt::format("{:g} m", of.promised_m),
                      fmt::format("{:.6g} m", of.largest_error_m), std::to_string(of.voids)});
  }
  const std::vector<std::vector<std::string>> rows{
      {"bytes", fmt::format("{}: {:.3f} bits a sample", built.bytes, built.bits_per_sample)},
      {"ratio", fmt::format("{:.2f} to 1 of 16 bits a sample, {:.2f} to 1 of the {} bytes of its "
                            "samples in memory",
                            built.ratio_to_16_bits, built.ratio_to_raw(), built.raw_bytes)},
      {"patches", std::to_string(built.patches)},
      {"voids", fmt::format("{} of {} samples", built.voids, built.samples)},
      {"time", fmt::format("read {:.3f} s, code {:.3f} ({:.1f} megasamples/s), decode and compare "
                           "{:.3f} ({:.1f})",
                           built.read_s, built.encode_s, built.megasamples_per_s(built.encode_s),
                           built.check_s, built.megasamples_per_s(built.check_s))}};
  return text_table({{"level", true},
                     {"patches", true},
                     {"promised", true},
                     {"largest error", true},
                     {"voids", true}},
                    levels) +
         "\n" + text_table({{"", false}, {"", false}}, rows) +
         fmt::format(
             "\nEvery patch was decoded again from '{}' and keeps its error; every void is "
             "one.\n",
             options.output);
}

std::string build_json(const BuildOptions& options, const Built& built,
                       const Invocation& invocation) {
  nlohmann::ordered_json json{{"schema", "plumb.build/1"},
                              {"command", invocation.command_line()},
                              {"file", options.output},
                              {"method", options.method},
                              {"format_version", options.format_version},
                              {"patch_cells", options.patch_cells},
                              {"bytes", built.bytes},
                              {"samples", built.samples},
                              {"bits_per_sample", built.bits_per_sample},
                              {"raw_bytes", built.raw_bytes},
                              {"ratio_to_raw", built.ratio_to_raw()},
                              {"ratio_to_16_bits", built.ratio_to_16_bits},
                              {"promised_m", built.error_m},
                              {"largest_error_m", built.levels.front().largest_error_m},
                              {"voids", built.voids},
                              {"patches", built.patches}};
  for (std::size_t level = 0; level < built.levels.size(); ++level) {
    const patches::DecodedLevel& of = built.levels[level];
    json["levels"].push_back({{"level", level},
                              {"patches", of.patches},
                              {"promised_m", of.promised_m},
                              {"largest_error_m", of.largest_error_m},
                              {"voids_differ", of.voids_differ}});
  }
  json["timing"] = {{"read_s", built.read_s},
                    {"encode_s", built.encode_s},
                    {"check_s", built.check_s},
                    {"encode_megasamples_per_s", built.megasamples_per_s(built.encode_s)},
                    {"check_megasamples_per_s", built.megasamples_per_s(built.check_s)}};
  return json.dump(2) + "\n";
}

// A file of stacks is exact: what speaks of errors and patches is not for it.
int run_stacks(const BuildOptions& options, const Invocation& invocation) {
  const BuildOptions defaults;
  if (!options.error.empty() || options.format_version != defaults.format_version ||
      options.patch_cells != defaults.patch_cells)
    input_error(
        "--method stacks: heights of stacks are exact, so --error, --format-version and "
        "--patch-cells are not for it");
  Progress progress;
  const std::string result = build_stacks(options.terrain, options.stacks, options.output,
                                          options.json, invocation, progress);
  progress.finish();
  std::cout << result;
  return 0;
}

int run_build(const BuildOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  check_output(options);
  if (options.method == "stacks") return run_stacks(options, invocation);
  if (!(options.stacks == StackBuildOptions{}))
    input_error("--method {}: layers, voxels and meshes are for --method stacks", options.method);
  if (options.terrain.terrain.empty()) input_error("TERRAIN is required");
  Progress progress;
  const Built built = build(options, progress);
  progress.finish();
  std::cout << (options.json ? build_json(options, built, invocation) : build_text(options, built));
  return 0;
}

}  // namespace

Command build_command() {
  Command command;
  command.name = "build";
  command.summary =
      "Code a terrain as patches of many levels, within an error in metres; or as stacks of "
      "material, exactly";
  command.example =
      "plumb build 'generate:alpine?size=513&seed=7' --method tessellation --error 1m -o t.plumb";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<BuildOptions>();
    add_terrain_options(options, values->terrain, false, false);
    add_stack_build_options(options, values->stacks);
    options.group("File");
    std::vector<std::string> methods;
    for (const Buildable& row : buildables()) methods.push_back(row.method);
    methods.push_back("stacks");
    options.choice(values->method, "--method", methods, "What is to draw from it (tessellation)");
    options.text(values->error, "--error", "NUMBERm",
                 "No decoded height is farther from the terrain's; stacks are exact");
    options.integer(values->format_version, "--format-version", "N",
                    "1: coded as published, 2: modelled, which is smaller (2)", 1, 2);
    options.integer(values->patch_cells, "--patch-cells", "N",
                    "Cells along a patch, a power of two from 8 to 1024 (128)", 8, 1024);
    options.group("Output");
    add_output_option(options, values->output,
                      "The file; it is read again and compared before it has this name, so - is "
                      "none");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_build(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
