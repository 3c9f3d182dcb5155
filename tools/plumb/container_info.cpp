#include "container_info.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "text_table.h"

namespace plumb::tool {
namespace {

using mesh::patch_quadtree::CodecVersion;
using mesh::patch_quadtree::Container;
using mesh::patch_quadtree::ContainerHeader;
using mesh::patch_quadtree::PatchLayout;
using mesh::patch_quadtree::Payload;

using Rows = std::vector<std::vector<std::string>>;

double samples_of(const Container& container) {
  const PatchLayout& layout = container.header().layout;
  return static_cast<double>(layout.columns) * layout.rows;
}

const char* words_for(CodecVersion version) {
  return version == CodecVersion::Published ? "as published" : "modelled";
}

std::string step_text(const ContainerHeader& h) {
  return h.quantiser.rule == mesh::patch_quadtree::StepRule::Same
             ? fmt::format("{:.10g} m on every level", h.quantiser.step_m)
             : fmt::format("{:.10g} m, doubled with each level", h.quantiser.step_m);
}

std::string facts(const Container& container) {
  const ContainerHeader& h = container.header();
  const PatchLayout& layout = h.layout;
  Rows rows{{"file", container.name()},
            {"terrain", h.source},
            {"checksum", fmt::format("{:016x}", h.terrain_checksum)},
            {"size", fmt::format("{} x {} samples", layout.columns, layout.rows)}};
  if (!h.crs.empty()) rows.push_back({"system", h.crs});
  rows.push_back({"spacing", fmt::format("{:.8g} x {:.8g} m", h.dx_m, h.dy_m)});
  rows.push_back({"origin", fmt::format("({:.10g}, {:.10g}) m, the south-western sample",
                                        h.origin_m.x, h.origin_m.y)});
  rows.push_back({"holds", fmt::format("{}, format version {} ({})", name_of(h.payload),
                                       static_cast<int>(h.version), words_for(h.version))});
  rows.push_back(
      {"patches", fmt::format("{} on {} levels, {} x {} cells each", layout.patch_count(),
                              layout.levels, layout.patch_cells, layout.patch_cells)});
  rows.push_back({"error", fmt::format("at most {:g} m", h.error_m)});
  rows.push_back({"step", step_text(h)});
  rows.push_back({"bytes", fmt::format("{}: {:.3f} bits a sample, {:.2f} times less than 16 bits",
                                       container.file_bytes(), bits_per_sample(container),
                                       ratio_to_16_bits(container))});
  return text_table({{"", false}, {"", false}}, rows);
}

}  // namespace

std::vector<LevelBytes> level_bytes(const Container& container) {
  const PatchLayout& layout = container.header().layout;
  const bool by_family = container.header().version == CodecVersion::Published;
  std::vector<LevelBytes> levels(static_cast<std::size_t>(layout.levels));
  for (int level = 0; level < layout.levels; ++level) {
    LevelBytes& of = levels[static_cast<std::size_t>(level)];
    of.columns = layout.patch_columns(level);
    of.rows = layout.patch_rows(level);
    for (std::int64_t k = layout.first_of_level(level); k < layout.first_of_level(level - 1); ++k) {
      of.payload += container.payload_bytes(k);
      if (!by_family) of.heights += container.heights_bytes(k);
      if (by_family && level > 0)
        levels[static_cast<std::size_t>(level) - 1].heights += container.heights_bytes(k);
    }
  }
  if (by_family) levels.back().heights += container.heights_bytes(layout.patch_count());
  return levels;
}

double bits_per_sample(const Container& container) {
  return 8.0 * static_cast<double>(container.file_bytes()) / samples_of(container);
}

double ratio_to_16_bits(const Container& container) { return 16.0 / bits_per_sample(container); }

const char* name_of(Payload payload) {
  switch (payload) {
    case Payload::Tessellation:
      return "tessellation";
    case Payload::RestrictedQuadtree:
      return "restricted-quadtree";
    default:
      return "heights alone";
  }
}

std::string container_text(const Container& container) {
  const std::vector<LevelBytes> levels = level_bytes(container);
  Rows rows;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const LevelBytes& of = levels[level];
    rows.push_back({std::to_string(level), fmt::format("{} x {}", of.columns, of.rows),
                    fmt::format("{:g} m", container.header().promised_m(static_cast<int>(level))),
                    std::to_string(of.heights), std::to_string(of.payload)});
  }
  return facts(container) + "\n" +
         text_table({{"level", true},
                     {"patches", true},
                     {"error at most", true},
                     {"bytes of heights", true},
                     {"of bounds", true}},
                    rows);
}

std::string container_json(const Container& container, const Invocation& invocation) {
  const ContainerHeader& h = container.header();
  nlohmann::ordered_json json{
      {"schema", "plumb.container/1"},
      {"command", invocation.command_line()},
      {"file", container.name()},
      {"format_version", static_cast<int>(h.version)},
      {"payload", name_of(h.payload)},
      {"terrain",
       {{"source", h.source},
        {"checksum", fmt::format("{:016x}", h.terrain_checksum)},
        {"columns", h.layout.columns},
        {"rows", h.layout.rows},
        {"crs", h.crs},
        {"spacing_m", {h.dx_m, h.dy_m}},
        {"origin_m", {h.origin_m.x, h.origin_m.y}}}},
      {"patch_cells", h.layout.patch_cells},
      {"error_m", h.error_m},
      {"step_m", h.quantiser.step_m},
      {"step_doubles", h.quantiser.rule != mesh::patch_quadtree::StepRule::Same},
      {"bytes", container.file_bytes()},
      {"bits_per_sample", bits_per_sample(container)},
      {"ratio_to_16_bits", ratio_to_16_bits(container)}};
  const std::vector<LevelBytes> levels = level_bytes(container);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    json["levels"].push_back({{"level", level},
                              {"patches", {levels[level].columns, levels[level].rows}},
                              {"promised_m", h.promised_m(static_cast<int>(level))},
                              {"heights_bytes", levels[level].heights},
                              {"payload_bytes", levels[level].payload}});
  }
  return json.dump(2) + "\n";
}

}  // namespace plumb::tool
