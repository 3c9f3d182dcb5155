#include "stack_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "terrain/stacks/stack_import_mesh.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

using terrain::StackField;

struct Facts {
  std::int64_t holes = 0;
  std::size_t most_layers = 0;
  double voxels = 0.0;  // in all, a byte each
  std::vector<double> volumes_m3;
  double volume_m3 = 0.0;

  double share(std::size_t material) const {
    return volume_m3 > 0.0 ? volumes_m3[material] / volume_m3 : 0.0;
  }
};

Facts facts_of(const StackField& field) {
  Facts facts;
  facts.holes = std::count(field.holes.begin(), field.holes.end(), std::uint8_t{1});
  for (std::size_t k = 0; k + 1 < field.first_layer.size(); ++k)
    facts.most_layers =
        std::max<std::size_t>(facts.most_layers, field.first_layer[k + 1] - field.first_layer[k]);
  facts.voxels = static_cast<double>(field.size()) * field.voxels;
  facts.volumes_m3 = terrain::volumes_m3(field);
  for (const double volume : facts.volumes_m3) facts.volume_m3 += volume;
  return facts;
}

double bits_a_stack(const StackField& field, std::int64_t bytes) {
  return 8.0 * static_cast<double>(bytes) / static_cast<double>(field.size());
}

}  // namespace

std::string stacks_text(const StackField& field, const std::optional<StackFileSize>& of) {
  const Facts facts = facts_of(field);
  const auto stacks = static_cast<double>(field.size());
  std::vector<std::vector<std::string>> rows;
  const auto add_rows = [&](const std::vector<std::vector<std::string>>& more) {
    rows.insert(rows.end(), more.begin(), more.end());
  };
  if (of) rows.push_back({"file", of->file});
  add_rows({{"terrain", field.provenance.source},
            {"checksum", fmt::format("{:016x}", checksum(field))},
            {"size", fmt::format("{} x {} stacks, {} voxels up", field.columns, field.rows,
                                 field.voxels)}});
  const std::string system = terrain::system_of_coordinates(field.provenance);
  if (!system.empty()) rows.push_back({"system", system});
  rows.push_back({"spacing", fmt::format("{:.8g} x {:.8g} m, voxels {:.8g} m high", field.dx_m,
                                         field.dy_m, field.voxel_m)});
  rows.push_back({"origin", fmt::format("({:.10g}, {:.10g}) m, the south-western stack",
                                        field.origin_m.x, field.origin_m.y)});
  rows.push_back({"heights", fmt::format("{:.8g} to {:.8g} m", field.low_m, field.high_m())});
  rows.push_back(
      {"layers", fmt::format("{}: {:.3f} a stack, at most {}", field.end_m.size(),
                             static_cast<double>(field.end_m.size()) / stacks, facts.most_layers)});
  rows.push_back({"holes", fmt::format("{} of {} stacks", facts.holes, field.size())});
  if (of)
    rows.push_back({"bytes", fmt::format("{}: {:.3f} bits a stack", of->bytes,
                                         bits_a_stack(field, of->bytes))});
  rows.push_back({"memory", fmt::format("{} bytes", field.bytes())});
  const std::string of_file =
      of ? fmt::format(" {:.4g} times the file,", facts.voxels / static_cast<double>(of->bytes))
         : "";
  rows.push_back({"voxels", fmt::format("{:.0f} bytes, were each a byte:{} {:.4g} times the memory",
                                        facts.voxels, of_file,
                                        facts.voxels / static_cast<double>(field.bytes()))});
  for (const std::string& line : field.provenance.assumptions) rows.push_back({"assumed", line});
  std::vector<std::vector<std::string>> materials;
  for (std::size_t k = 0; k < field.materials.size(); ++k)
    materials.push_back({std::to_string(k), field.materials[k].name,
                         fmt::format("{:.6g}", facts.volumes_m3[k]),
                         fmt::format("{:.3f} %", 100.0 * facts.share(k))});
  return text_table({{"", false}, {"", false}}, rows) + "\n" +
         text_table(
             {{"number", true}, {"material", false}, {"cubic metres", true}, {"share", true}},
             materials) +
         "\nAir counts as far as a stack's last layer covers it.\n";
}

std::string stacks_json(const StackField& field, const std::optional<StackFileSize>& of,
                        const Invocation& invocation) {
  const Facts facts = facts_of(field);
  nlohmann::ordered_json json{
      {"schema", "plumb.stacks/1"},
      {"command", invocation.command_line()},
      {"file", of ? nlohmann::ordered_json(of->file) : nullptr},
      {"terrain",
       {{"source", field.provenance.source},
        {"checksum", fmt::format("{:016x}", checksum(field))},
        {"columns", field.columns},
        {"rows", field.rows},
        {"crs", field.provenance.crs},
        {"spacing_m", {field.dx_m, field.dy_m}},
        {"origin_m", {field.origin_m.x, field.origin_m.y}}}},
      {"voxels", field.voxels},
      {"voxel_m", field.voxel_m},
      {"low_m", field.low_m},
      {"high_m", field.high_m()},
      {"layers", field.end_m.size()},
      {"most_layers", facts.most_layers},
      {"holes", facts.holes},
      {"bytes", of ? nlohmann::ordered_json(of->bytes) : nullptr},
      {"bits_per_stack", of ? nlohmann::ordered_json(bits_a_stack(field, of->bytes)) : nullptr},
      {"memory_bytes", field.bytes()},
      {"voxel_bytes", facts.voxels},
      {"assumptions", field.provenance.assumptions}};
  for (std::size_t k = 0; k < field.materials.size(); ++k)
    json["materials"].push_back({{"name", field.materials[k].name},
                                 {"volume_m3", facts.volumes_m3[k]},
                                 {"share", facts.share(k)}});
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace plumb::tool
