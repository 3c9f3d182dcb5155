#include "terrain/read_options.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/number_text.h"

namespace plumb::terrain {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<int> whole_number(const std::string& text) {
  const auto value = parse_integer(text);
  if (!value || *value < std::numeric_limits<int>::min() ||
      *value > std::numeric_limits<int>::max()) {
    return std::nullopt;
  }
  return static_cast<int>(*value);
}

bool is_on_earth(const TileOrigin& origin) {  // false for NaN
  return std::abs(origin.longitude_deg) <= 180.0 && origin.latitude_deg >= -90.0 &&
         origin.latitude_deg <= 89.0;
}

bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }

}  // namespace

const char* name_of(Decode decode) {
  switch (decode) {
    case Decode::Unspecified:
      return "unspecified";
    case Decode::Grey:
      return "grey";
    case Decode::TerrainRgb:
      return "terrain-rgb";
    case Decode::Terrarium:
      return "terrarium";
  }
  return "?";
}

const char* name_of(NoDataPolicy policy) { return policy == NoDataPolicy::Hole ? "hole" : "fill"; }
const char* name_of(ByteOrder order) { return order == ByteOrder::Little ? "little" : "big"; }

Window parse_window(const std::string& text) {
  const auto parts = split(text, ',');
  std::vector<int> numbers;
  for (const std::string& part : parts) {
    if (const auto number = whole_number(part)) numbers.push_back(*number);
  }
  if (parts.size() != 4 || numbers.size() != 4) {
    input_error(
        "window '{}': expected x,y,width,height in the file's columns and rows from its top left",
        text);
  }
  const Window window{numbers[0], numbers[1], numbers[2], numbers[3]};
  if (window.x < 0 || window.y < 0 || window.width < 1 || window.height < 1) {
    input_error("window '{}': x and y must be >= 0, width and height >= 1", text);
  }
  return window;
}

Spacing parse_spacing(const std::string& text) {
  const auto parts = split(text, ',');
  const auto x = parse_number(parts[0]);
  const auto y = parts.size() == 2 ? parse_number(parts[1]) : x;
  if (parts.size() > 2 || !x || !y || !is_positive(*x) || !is_positive(*y)) {
    input_error("spacing '{}': expected DX or DX,DY in metres, greater than 0", text);
  }
  return {*x, *y};
}

Decode parse_decode(const std::string& text) {
  for (const Decode decode : {Decode::Grey, Decode::TerrainRgb, Decode::Terrarium}) {
    if (text == name_of(decode)) return decode;
  }
  input_error("decode '{}': expected grey, terrain-rgb or terrarium", text);
}

bool parse_surface(const std::string& text) {
  if (text == "top") return true;
  if (text == "stacks") return false;
  input_error("surface '{}': expected stacks or top", text);
}

NoDataPolicy parse_no_data_policy(const std::string& text) {
  for (const NoDataPolicy policy : {NoDataPolicy::Hole, NoDataPolicy::Fill}) {
    if (text == name_of(policy)) return policy;
  }
  input_error("no-data policy '{}': expected hole or fill", text);
}

RawSize parse_raw_size(const std::string& text) {
  const auto parts = split(text, 'x');
  const auto columns = whole_number(parts[0]);
  const auto rows = whole_number(parts.size() == 2 ? parts[1] : std::string());
  if (!columns || !rows || *columns < 1 || *rows < 1) {
    input_error("raw size '{}': expected WIDTHxHEIGHT in samples, both >= 1", text);
  }
  return {*columns, *rows};
}

TileOrigin parse_origin(const std::string& text) {
  const auto parts = split(text, ',');
  const auto longitude = parse_number(parts[0]);
  const auto latitude = parts.size() == 2 ? parse_number(parts[1]) : std::nullopt;
  if (!longitude || !latitude || !is_on_earth({*longitude, *latitude})) {
    input_error(
        "origin '{}': expected LONGITUDE,LATITUDE of the south-west sample in degrees, -180 to 180 "
        "and -90 to 89",
        text);
  }
  return {*longitude, *latitude};
}

ByteOrder parse_byte_order(const std::string& text) {
  for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
    if (text == name_of(order)) return order;
  }
  input_error("byte order '{}': expected little or big", text);
}

void check(const ReadOptions& options) {
  for (const auto& spacing : {options.spacing_x_m, options.spacing_y_m}) {
    if (spacing && !is_positive(*spacing)) {
      input_error("spacing {}: expected metres, greater than 0", *spacing);
    }
  }
  if (options.spacing_y_m && !options.spacing_x_m) {
    input_error("a spacing of rows needs a spacing of columns: DX,DY");
  }
  if (options.origin && !is_on_earth(*options.origin)) {
    input_error("origin {},{}: expected degrees, -180 to 180 and -90 to 89",
                options.origin->longitude_deg, options.origin->latitude_deg);
  }
  if (options.band < 1) input_error("band {}: bands are counted from 1", options.band);
  if (options.height_scale == 0.0 || !std::isfinite(options.height_scale)) {
    input_error("height scale {}: expected a finite number that is not 0", options.height_scale);
  }
  if (!std::isfinite(options.height_offset_m)) {
    input_error("height offset {}: expected a finite number of metres", options.height_offset_m);
  }
}

Window window_in(const ReadOptions& options, const std::string& file, int columns, int rows) {
  if (!options.window) return {0, 0, columns, rows};
  const Window& w = *options.window;
  if (w.width < 1 || w.height < 1) {
    input_error("{}: window {},{},{},{} is empty: width and height must be >= 1", file, w.x, w.y,
                w.width, w.height);
  }
  if (w.x < 0 || w.y < 0 || std::int64_t{w.x} + w.width > columns ||
      std::int64_t{w.y} + w.height > rows) {
    input_error("{}: window {},{},{},{} does not lie inside its {} columns and {} rows", file, w.x,
                w.y, w.width, w.height, columns, rows);
  }
  return w;
}

}  // namespace plumb::terrain
