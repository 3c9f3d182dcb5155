#include "audit/terrain_table.h"

#include <filesystem>

#include "terrain/heightfield.h"

namespace plumb::audit {
namespace {

struct Key {
  const char* name;
  void (*read)(TerrainTable&, const TomlValue&);
};

constexpr Key kTerrainKeys[] = {
    {"source", [](TerrainTable& t, const TomlValue& v) { t.source = word_in(v); }},
    {"window",
     [](TerrainTable& t, const TomlValue& v) {
       t.read.window = parsed_argument(v, terrain::parse_window);
     }},
    {"spacing",
     [](TerrainTable& t, const TomlValue& v) {
       const terrain::Spacing spacing = parsed_argument(v, terrain::parse_spacing);
       t.read.spacing_x_m = spacing.x_m;
       t.read.spacing_y_m = spacing.y_m;
     }},
    {"band",
     [](TerrainTable& t, const TomlValue& v) { t.read.band = whole_number_in(v, 1, 65535); }},
    {"decode",
     [](TerrainTable& t, const TomlValue& v) {
       t.read.decode = parsed_argument(v, terrain::parse_decode);
     }},
    {"height_scale",
     [](TerrainTable& t, const TomlValue& v) { t.read.height_scale = number_in(v); }},
    {"height_offset",
     [](TerrainTable& t, const TomlValue& v) { t.read.height_offset_m = number_in(v); }},
    {"nodata", [](TerrainTable& t, const TomlValue& v) { t.read.no_data = number_in(v); }},
    {"no_data",
     [](TerrainTable& t, const TomlValue& v) {
       t.read.no_data_policy = parsed_argument(v, terrain::parse_no_data_policy);
     }},
    {"crs", [](TerrainTable& t, const TomlValue& v) { t.read.crs = word_in(v); }},
    {"raw",
     [](TerrainTable& t, const TomlValue& v) {
       t.read.raw_size = parsed_argument(v, terrain::parse_raw_size);
     }},
    {"origin",
     [](TerrainTable& t, const TomlValue& v) {
       t.read.origin = parsed_argument(v, terrain::parse_origin);
     }},
    {"byte_order",
     [](TerrainTable& t, const TomlValue& v) {
       t.read.byte_order = parsed_argument(v, terrain::parse_byte_order);
     }},
    {"surface",
     [](TerrainTable& t, const TomlValue& v) {
       t.read.top_surface = parsed_argument(v, terrain::parse_surface);
     }},
    {"diagonal",
     [](TerrainTable& t, const TomlValue& v) {
       t.diagonal = name_of(parsed_argument(v, terrain::parse_diagonal));
     }},
};

}  // namespace

std::vector<std::string> terrain_keys() {
  std::vector<std::string> names;
  for (const Key& key : kTerrainKeys) names.emplace_back(key.name);
  return names;
}

bool read_terrain_entry(TerrainTable& table, const TomlEntry& entry) {
  for (const Key& key : kTerrainKeys) {
    if (entry.key != key.name) continue;
    key.read(table, entry.value);
    return true;
  }
  return false;
}

std::vector<std::pair<std::string, std::string>> argument_texts(const terrain::ReadOptions& read) {
  const terrain::ReadOptions usual;
  std::vector<std::pair<std::string, std::string>> texts;
  const auto add = [&](const char* name, std::string value) {
    texts.emplace_back(name, std::move(value));
  };
  if (const auto& w = read.window)
    add("window", fmt::format("{},{},{},{}", w->x, w->y, w->width, w->height));
  if (read.spacing_x_m)
    add("spacing",
        fmt::format("{},{}", *read.spacing_x_m, read.spacing_y_m.value_or(*read.spacing_x_m)));
  if (read.band != usual.band) add("band", fmt::format("{}", read.band));
  if (read.decode != usual.decode) add("decode", name_of(read.decode));
  if (read.height_scale != usual.height_scale)
    add("height_scale", fmt::format("{}", read.height_scale));
  if (read.height_offset_m != usual.height_offset_m)
    add("height_offset", fmt::format("{}", read.height_offset_m));
  if (read.no_data) add("nodata", fmt::format("{}", *read.no_data));
  if (read.no_data_policy != usual.no_data_policy) add("no_data", name_of(read.no_data_policy));
  if (!read.crs.empty()) add("crs", read.crs);
  if (read.raw_size) add("raw", fmt::format("{}x{}", read.raw_size->columns, read.raw_size->rows));
  if (const auto& origin = read.origin)
    add("origin", fmt::format("{},{}", origin->longitude_deg, origin->latitude_deg));
  if (read.byte_order != usual.byte_order) add("byte_order", name_of(read.byte_order));
  if (read.top_surface) add("surface", "top");
  return texts;
}

std::string beside(const std::string& source, const std::string& folder) {
  if (folder.empty() || source.find(':') != std::string::npos || source.starts_with("/"))
    return source;
  return (std::filesystem::path(folder) / source).lexically_normal().string();
}

}  // namespace plumb::audit
