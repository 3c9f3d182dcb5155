// Heightfields as GeoTIFF files.
#pragma once

#include <filesystem>
#include <string>

#include "terrain/heightfield.h"

namespace plumb::terrain {

/// How a height is stored. Whole numbers are for terrains of whole metres alone: nothing is
/// rounded.
enum class GeotiffSamples {
  Float32,  // a void is NaN
  Int16,    // -32767 to 32767 m, a void is -32768
  Uint16,   // 0 to 65534 m, a void is 65535
};
enum class GeotiffCompression { Deflate, Zstd };

struct GeotiffOptions {
  GeotiffSamples samples = GeotiffSamples::Float32;
  GeotiffCompression compression = GeotiffCompression::Deflate;  // Zstd is faster; fewer read it
  std::string description = "";  // one line that is kept in the file
};

/// Writes a tiled file, rows from the north, whole or not at all, and nothing beside it; the same
/// bytes from the same terrain, but for another version of GDAL or of its compressor.
///
///   (1) load_terrain gives the same heights (zero without its sign), voids and spacings, and
///       system_of_coordinates for its crs; the same origin, or one half an ulp of the file's
///       north-west corner off where no corner gives its bits.
///   (2) A sample stands at its pixel's centre.
/// A coordinate system is written if it is a projected one of an authority ("EPSG:2056") that the
/// terrain's coordinates are in, in its own units. Else they are metres of a local system that
/// has system_of_coordinates for its name, or, if that is empty, of none that is named.
/// Throws InputError with path and cause if the file cannot be written, or if its samples are whole
/// numbers and a height is none of them; std::invalid_argument as require_valid does.
void write_geotiff(const std::filesystem::path& path, const Heightfield& field,
                   const GeotiffOptions& options = {});

}  // namespace plumb::terrain
