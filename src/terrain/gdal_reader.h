// Elevation files of every format that GDAL knows.
#pragma once

#include <string>

#include "terrain/heightfield.h"
#include "terrain/read_options.h"

namespace plumb::terrain {

/// Reads a GeoTIFF, SRTM .hgt, Arc/Info ASCII grid, USGS DEM or anything else that GDAL opens.
///
/// Heights are (stored * scale + offset) of the band, in the band's unit or the vertical unit of
/// its coordinate system, made metres; samples that equal the band's no-data value or that the
/// file's mask hides are void. Integers are exact up to 2^53 before they become float32. Where the
/// samples stand: terrain/georeference.h. With options.crs GDAL's warper resamples (bilinear) onto
/// a grid of that system; only there the last bits are GDAL's, not ours.
/// An .hgt file whose name does not state its corner, which GDAL refuses, is recognised by its size
/// and placed by options.origin: the same heights, voids and spacing as under its proper name.
/// Throws InputError, one line that holds what GDAL had to say.
Heightfield read_with_gdal(const std::string& file, const ReadOptions& options);

}  // namespace plumb::terrain
