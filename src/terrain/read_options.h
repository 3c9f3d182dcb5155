// How a terrain file is to be read: what its user says about it.
#pragma once

#include <optional>
#include <string>

namespace plumb::terrain {

/// A part of a file in the file's own columns and rows, counted from its top left (north-west).
struct Window {
  int x = 0, y = 0;           // first column and row, >= 0
  int width = 0, height = 0;  // >= 1
  friend bool operator==(const Window&, const Window&) = default;
};

/// What the channels of an image mean.
enum class Decode {
  Unspecified,  // one channel is a height; a colour image is an error
  Grey,         // `band` of the image is a height, whatever else is in it
  TerrainRgb,   // -10000 + 0.1 (65536 R + 256 G + B) metres
  Terrarium,    // 256 R + G + B / 256 - 32768 metres
};

enum class NoDataPolicy {
  Hole,  // no surface there
  Fill,  // the height of the nearest sample that has one
};

enum class ByteOrder { Little, Big };

/// Size of a file of bare samples (.r16: uint16, .r32: float32), which states none.
struct RawSize {
  int columns = 0, rows = 0;  // >= 1
  friend bool operator==(const RawSize&, const RawSize&) = default;
};

/// Where a tile's south-west sample stands, degrees.
struct TileOrigin {
  double longitude_deg = 0.0;  // -180 to 180
  double latitude_deg = 0.0;   // -90 to 89, as a tile is a degree high
  friend bool operator==(const TileOrigin&, const TileOrigin&) = default;
};

struct ReadOptions {
  std::optional<double> spacing_x_m;  // > 0; overrides what the file says
  std::optional<double> spacing_y_m;  // > 0; as spacing_x_m where absent
  int band = 1;                       // >= 1
  std::optional<Window> window;       // all of the file where absent
  Decode decode = Decode::Unspecified;
  double height_scale = 1.0;      // on top of the file's own scale and unit, not 0
  double height_offset_m = 0.0;   // added last
  std::optional<double> no_data;  // a stored value that is void, besides the file's own
  NoDataPolicy no_data_policy = NoDataPolicy::Hole;
  std::optional<TileOrigin> origin;  // of an .hgt file whose name does not state it
  std::string crs;                   // to reproject into, "EPSG:2056"; empty: as it is
  std::optional<RawSize> raw_size;   // of .r16 and .r32 files
  ByteOrder byte_order = ByteOrder::Little;
  bool top_surface = false;     // of a terrain of stacks its top surface alone
  bool require_spacing = true;  // false: a file without spacing gets 1 m, and a line that says so

  friend bool operator==(const ReadOptions&, const ReadOptions&) = default;
};

const char* name_of(Decode decode);        // "unspecified", "grey", "terrain-rgb", "terrarium"
const char* name_of(NoDataPolicy policy);  // "hole", "fill"
const char* name_of(ByteOrder order);      // "little", "big"

/// The words of the command line. Each throws InputError that says what was expected.
Window parse_window(const std::string& text);  // "x,y,width,height"
struct Spacing {
  double x_m = 1.0, y_m = 1.0;
};
Spacing parse_spacing(const std::string& text);  // "DX" or "DX,DY", metres
Decode parse_decode(const std::string& text);    // "grey", "terrain-rgb" or "terrarium"
NoDataPolicy parse_no_data_policy(const std::string& text);
bool parse_surface(const std::string& text);       // "stacks" or "top", which is true
RawSize parse_raw_size(const std::string& text);   // "WIDTHxHEIGHT"
TileOrigin parse_origin(const std::string& text);  // "LONGITUDE,LATITUDE", degrees
ByteOrder parse_byte_order(const std::string& text);

/// Throws InputError unless every option is in the range stated above.
void check(const ReadOptions& options);

/// The window that `options` asks for in a file of this size. Throws InputError naming `file` if it
/// does not lie inside.
Window window_in(const ReadOptions& options, const std::string& file, int columns, int rows);

}  // namespace plumb::terrain
