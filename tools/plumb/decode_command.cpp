// plumb decode: heights out of a coded terrain.
#include <fmt/format.h>

#include <glm/vec2.hpp>

#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "command.h"
#include "common_options.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "mesh/patch_quadtree/patch_decoder.h"
#include "progress.h"
#include "terrain/geotiff_writer.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;
using mesh::patch_quadtree::Container;
using mesh::patch_quadtree::ContainerHeader;
using mesh::patch_quadtree::PatchDecoder;
using mesh::patch_quadtree::PatchLayout;
using mesh::patch_quadtree::PatchPlace;

struct DecodeOptions {
  std::string file, output, patch, samples = "float32", compress = "deflate";
  int level = -1, threads = 0;
  bool json = false;
};

PatchPlace parse_patch(const std::string& text) {
  std::array<int, 3> numbers{};
  std::string_view rest = text;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? rest.find(',') : rest.size();
    const auto number =
        end == std::string_view::npos ? std::nullopt : parse_integer(rest.substr(0, end));
    if (!number || *number < 0 || *number > 0x7fffffff)
      input_error("--patch '{}': expected LEVEL,PX,PY, three whole numbers from 0", text);
    numbers[k] = static_cast<int>(*number);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

// What is asked for of a file.
struct Part {
  int level = 0;
  std::optional<PatchPlace> patch;
};

Part part_of(const DecodeOptions& options, const Container& container) {
  const PatchLayout& layout = container.header().layout;
  Part part;
  if (!options.patch.empty()) {
    if (options.level >= 0) input_error("--patch says its level itself: leave --level out");
    part.patch = parse_patch(options.patch);
    part.level = part.patch->level;
  } else if (options.level > 0) {
    part.level = options.level;
  }
  if (part.level >= layout.levels)
    input_error("{}: there is no level {}, the coarsest is {}", options.file, part.level,
                layout.levels - 1);
  if (part.patch && !layout.contains(*part.patch))
    input_error("{}: level {} has {} x {} patches, there is no ({}, {})", options.file, part.level,
                layout.patch_columns(part.level), layout.patch_rows(part.level), part.patch->px,
                part.patch->py);
  return part;
}

// Samples of a level along a side that stand on its grid: the last of the terrain may not.
int on_grid(int samples, int level) { return ((samples - 1) >> level) + 1; }

// columns x rows of a grid from (i, j).
Grid<float> cut(const Grid<float>& grid, int i, int j, int columns, int rows) {
  Grid<float> part(columns, rows);
  for (int row = 0; row < rows; ++row)
    std::copy_n(&grid(i, j + row), columns, part.row(row).begin());
  return part;
}

// The terrain's last columns and rows that a part does not reach, though it ends where the level's
// grid does: they stand between that grid's last sample and the terrain's.
glm::ivec2 left_out(const PatchLayout& layout, const Part& part) {
  glm::ivec2 counts{0, 0};
  for (int axis = 0; axis < 2; ++axis) {
    const int samples = axis == 0 ? layout.columns : layout.rows,
              cells = on_grid(samples, part.level) - 1;
    const auto ends_before = [&](int patch) { return (patch + 1) * layout.patch_cells <= cells; };
    if (part.patch && ends_before(axis == 0 ? part.patch->px : part.patch->py)) continue;
    counts[axis] = samples - 1 - (cells << part.level);
  }
  return counts;
}

// The part as a terrain of its own. A patch is without its margin, and of samples that lie on the
// terrain.
terrain::Heightfield decoded(const Container& container, const Part& part) {
  const ContainerHeader& h = container.header();
  const PatchDecoder decoder(container);
  const int columns = on_grid(h.layout.columns, part.level),
            rows = on_grid(h.layout.rows, part.level), n = h.layout.patch_cells;
  terrain::Heightfield field;
  int first_i = 0, first_j = 0;
  if (part.patch) {
    first_i = part.patch->px * n;
    first_j = part.patch->py * n;
    field.heights_m = cut(decoder.heights(*part.patch), 1, 1, std::min(n + 1, columns - first_i),
                          std::min(n + 1, rows - first_j));
  } else {
    Grid<float> heights = decoder.level_heights(part.level);
    field.heights_m = heights.columns() == columns && heights.rows() == rows
                          ? std::move(heights)
                          : cut(heights, 0, 0, columns, rows);
  }
  field.dx_m = std::ldexp(h.dx_m, part.level);
  field.dy_m = std::ldexp(h.dy_m, part.level);
  field.origin_m = h.origin_m + glm::dvec2(first_i * field.dx_m, first_j * field.dy_m);
  field.provenance.source = container.name();
  field.provenance.crs = h.crs;
  return field;
}

enum class Target { Tif, R32 };

Target target_of(const DecodeOptions& options) {
  if (options.output.empty()) input_error("decode needs -o: a file (.tif or .r32)");
  const std::string extension = fs::path(options.output).extension().string();
  if (extension == ".tif" || extension == ".tiff") return Target::Tif;
  if (extension != ".r32")
    input_error("-o '{}': expected a name that ends in .tif or .r32", options.output);
  if (options.samples != "float32" || options.compress != "deflate")
    input_error(
        "-o '{}': bare samples are float32, as they are: --samples and --compress are for "
        ".tif",
        options.output);
  return Target::R32;
}

// Little-endian floats, rows from the north.
void write_r32(const std::string& path, const terrain::Heightfield& field) {
  std::string bytes;
  bytes.reserve(field.heights_m.size() * sizeof(float));
  std::vector<float> buffer;
  for (int j = field.rows() - 1; j >= 0; --j) {
    for (const float height : field.heights_m.row(j, buffer)) {
      const auto word = std::bit_cast<std::uint32_t>(height);
      for (int k = 0; k < 4; ++k) bytes += static_cast<char>(word >> (8 * k) & 255u);
    }
  }
  write_file_atomically(path, bytes);
}

void write(const DecodeOptions& options, Target target, const ContainerHeader& header,
           const Part& part, const terrain::Heightfield& field) {
  if (target == Target::R32) return write_r32(options.output, field);
  terrain::GeotiffOptions tif;
  if (options.samples == "int16") tif.samples = terrain::GeotiffSamples::Int16;
  if (options.samples == "uint16") tif.samples = terrain::GeotiffSamples::Uint16;
  if (options.compress == "zstd") tif.compression = terrain::GeotiffCompression::Zstd;
  tif.description =
      fmt::format("Level {} of {}, every height within {:g} m of it (terrain {:016x})", part.level,
                  header.source, header.promised_m(part.level), header.terrain_checksum);
  terrain::write_geotiff(options.output, field, tif);
}

std::int64_t voids_of(const terrain::Heightfield& field) {
  std::int64_t count = 0;
  for (int j = 0; j < field.rows(); ++j)
    for (int i = 0; i < field.columns(); ++i) count += field.is_void(i, j) ? 1 : 0;
  return count;
}

std::string left_out_text(const PatchLayout& layout, const glm::ivec2& counts) {
  std::string text;
  if (counts.x > 0) text = fmt::format("{} of {} columns in the east", counts.x, layout.columns);
  if (counts.x > 0 && counts.y > 0) text += ", ";
  if (counts.y > 0) text += fmt::format("{} of {} rows in the north", counts.y, layout.rows);
  return text + ", beyond the last that stands on the level's grid";
}

std::string decode_text(const DecodeOptions& options, const Part& part,
                        const ContainerHeader& header, const terrain::Heightfield& field) {
  std::vector<std::vector<std::string>> rows{
      {"terrain", header.source},
      {"level", part.patch
                    ? fmt::format("{}, patch ({}, {})", part.level, part.patch->px, part.patch->py)
                    : std::to_string(part.level)},
      {"size", fmt::format("{} x {} samples, {:.8g} x {:.8g} m apart", field.columns(),
                           field.rows(), field.dx_m, field.dy_m)},
      {"voids", std::to_string(voids_of(field))},
      {"error", fmt::format("at most {:g} m", header.promised_m(part.level))},
      {"file", options.output}};
  const glm::ivec2 missing = left_out(header.layout, part);
  if (missing != glm::ivec2(0))
    rows.insert(rows.begin() + 3, {"left out", left_out_text(header.layout, missing)});
  return text_table({{"", false}, {"", false}}, rows);
}

std::string decode_json(const DecodeOptions& options, const Part& part,
                        const ContainerHeader& header, const terrain::Heightfield& field,
                        double seconds, const Invocation& invocation) {
  nlohmann::ordered_json json{{"schema", "plumb.decode/1"},
                              {"command", invocation.command_line()},
                              {"source", header.source},
                              {"level", part.level}};
  if (part.patch) json["patch"] = {part.patch->px, part.patch->py};
  const glm::ivec2 missing = left_out(header.layout, part);
  json.update({{"file", options.output},
               {"columns", field.columns()},
               {"rows", field.rows()},
               {"left_out", {{"columns", missing.x}, {"rows", missing.y}}},
               {"spacing_m", {field.dx_m, field.dy_m}},
               {"origin_m", {field.origin_m.x, field.origin_m.y}},
               {"crs", field.provenance.crs},
               {"voids", voids_of(field)},
               {"promised_m", header.promised_m(part.level)},
               {"timing", {{"decode_s", seconds}}}});
  return json.dump(2) + "\n";
}

int run_decode(const DecodeOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  const Target target = target_of(options);
  const Container container{fs::path(options.file)};
  const Part part = part_of(options, container);
  Progress progress;
  progress.step("decoding");
  const auto begin = std::chrono::steady_clock::now();
  const terrain::Heightfield field = decoded(container, part);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  progress.step("writing");
  write(options, target, container.header(), part, field);
  progress.finish();
  std::cout << (options.json ? decode_json(options, part, container.header(), field, taken.count(),
                                           invocation)
                             : decode_text(options, part, container.header(), field));
  return 0;
}

}  // namespace

Command decode_command() {
  Command command;
  command.name = "decode";
  command.summary = "Write the heights of a coded terrain (.plumb), of any level or of one patch";
  command.example =
      "plumb build 'generate:alpine?size=257&seed=7' --error 1m -o t.plumb && plumb decode t.plumb "
      "-o t.tif";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<DecodeOptions>();
    options.argument(values->file, "FILE", "What plumb build wrote");
    options.integer(
        values->level, "--level", "N",
        "0, the finest, or a coarser one: every 2^N-th sample from the south-west, without "
        "a last column or row that is none of them (0)",
        0, 30);
    options.text(values->patch, "--patch", "LEVEL,PX,PY",
                 "One patch alone, by column and row of its level from the south-west");
    options.group("Output");
    add_output_option(options, values->output,
                      ".tif, a GeoTIFF, or .r32, bare little-endian floats, rows from the north");
    options.choice(values->samples, "--samples", {"float32", "int16", "uint16"},
                   "How a .tif stores a height; whole numbers for whole metres alone (float32)");
    options.choice(values->compress, "--compress", {"deflate", "zstd"},
                   "Of a .tif; zstd is faster, fewer programs read it (deflate)");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_decode(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
