#include "terrain/geotiff_writer.h"

#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/atomic_file.h"
#include "core/check.h"
#include "terrain/gdal_dataset.h"
#include "terrain/georeference.h"

namespace plumb::terrain {
namespace {

constexpr int kTile = 256;  // samples along a side

struct SampleFormat {
  GDALDataType type;
  const char* name;
  double lowest, highest, void_value;
  const char* predictor;
};

SampleFormat format_of(GeotiffSamples samples) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  switch (samples) {
    case GeotiffSamples::Int16:
      return {GDT_Int16, "int16", -32767.0, 32767.0, -32768.0, "2"};
    case GeotiffSamples::Uint16:
      return {GDT_UInt16, "uint16", 0.0, 65534.0, 65535.0, "2"};
    default:
      return {GDT_Float32, "float32", 0.0, 0.0, kNone, "3"};
  }
}

void require_whole_metres(const Heightfield& field, const SampleFormat& format,
                          const std::string& path) {
  std::vector<float> buffer;
  for (int j = 0; j < field.rows(); ++j) {
    for (const float height : field.heights_m.row(j, buffer)) {
      if (std::isnan(height)) continue;
      if (height != std::floor(height) || height < format.lowest || height > format.highest)
        input_error("cannot write '{}': {} holds whole metres from {} to {}, not {} m", path,
                    format.name, format.lowest, format.highest, height);
    }
  }
}

// "EPSG:2056": an authority's name and code, and nothing that could be a file or an address.
bool is_code(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) return false;
  return std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == ':' || c == '_' || c == '.';
  });
}

// Metres of no place on the earth.
OGRSpatialReference local(const std::string& name) {
  OGRSpatialReference crs;
  crs.SetLocalCS(name.c_str());
  crs.SetLinearUnits("metre", 1.0);
  return crs;
}

// What the file states; nothing where no system is known.
std::optional<OGRSpatialReference> system_of(const Heightfield& field) {
  const Provenance& from = field.provenance;
  if (!from.is_local && is_code(from.crs)) {
    const Complaints unknown_is_no_error;
    OGRSpatialReference crs;
    FileGeoreference g;
    const bool known =
        crs.SetFromUserInput(from.crs.c_str(),
                             OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) ==
        OGRERR_NONE;
    if (known) describe(crs, g);
    if (known && g.frame == Frame::Projected && g.crs == from.crs) {
      crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      return crs;
    }
    // Readers lay these out flat, so metres are not in them.
    if (known && g.frame != Frame::Projected) return local(local_system(from.crs));
  }
  if (const std::string name = system_of_coordinates(from); !name.empty()) return local(name);
  // So small a spacing, of no system, would be taken for degrees.
  if (field.dx_m <= 0.01 && field.dy_m <= 0.01) return local("local metres");
  return std::nullopt;
}

// The transform by which a reader places the samples where they stand.
std::array<double, 6> transform_of(const Heightfield& field, double metres_per_unit) {
  const double step_x = field.dx_m / metres_per_unit, step_y = field.dy_m / metres_per_unit;
  return {field.origin_m.x / metres_per_unit - 0.5 * step_x,
          step_x,
          0.0,
          field.origin_m.y / metres_per_unit + (field.rows() - 0.5) * step_y,
          0.0,
          -step_y};
}

Dataset created(const std::string& path, const Heightfield& field, const SampleFormat& format,
                const GeotiffOptions& options, const Complaints& complaints) {
  register_formats();
  CPLStringList creation;
  creation.SetNameValue("TILED", "YES");
  creation.SetNameValue("BLOCKXSIZE", std::to_string(kTile).c_str());
  creation.SetNameValue("BLOCKYSIZE", std::to_string(kTile).c_str());
  creation.SetNameValue("COMPRESS",
                        options.compression == GeotiffCompression::Zstd ? "ZSTD" : "DEFLATE");
  creation.SetNameValue("PREDICTOR", format.predictor);
  creation.SetNameValue("BIGTIFF", "IF_SAFER");
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  Dataset dataset(driver == nullptr ? nullptr
                                    : driver->Create(path.c_str(), field.columns(), field.rows(), 1,
                                                     format.type, creation.List()));
  if (!dataset) input_error("it cannot be made{}", complaints.text());
  double metres_per_unit = 1.0;
  if (const auto crs = system_of(field)) {
    dataset->SetSpatialRef(&*crs);
    metres_per_unit = crs->GetLinearUnits();
  }
  std::array<double, 6> transform = transform_of(field, metres_per_unit);
  dataset->SetGeoTransform(transform.data());
  if (!options.description.empty())
    dataset->SetMetadataItem("TIFFTAG_IMAGEDESCRIPTION", options.description.c_str());
  dataset->GetRasterBand(1)->SetNoDataValue(format.void_value);
  dataset->GetRasterBand(1)->SetUnitType("metre");
  return dataset;
}

// Tiles in the file's order, each written as soon as it is there: left to GDAL's cache, their order
// would depend on the machine's memory. What lies beyond the last column or row repeats it.
template <class Sample>
void write_tiles(GDALRasterBand& band, const Heightfield& field, const SampleFormat& format,
                 const Complaints& complaints) {
  const int across = (field.columns() + kTile - 1) / kTile,
            down = (field.rows() + kTile - 1) / kTile;
  std::vector<Sample> strip(static_cast<std::size_t>(across) * kTile * kTile);
  std::vector<float> buffer;
  for (int y = 0; y < down; ++y) {
    for (int r = 0; r < kTile; ++r) {
      const int j = field.rows() - 1 - std::min(y * kTile + r, field.rows() - 1);
      const auto row = field.heights_m.row(j, buffer);
      for (int i = 0; i < across * kTile; ++i) {
        const float height = row[static_cast<std::size_t>(std::min(i, field.columns() - 1))];
        const int tile = i / kTile, within = i % kTile;
        strip[(static_cast<std::size_t>(tile) * kTile + static_cast<std::size_t>(r)) * kTile +
              static_cast<std::size_t>(within)] =
            static_cast<Sample>(std::isnan(height) ? format.void_value : double{height});
      }
    }
    for (int x = 0; x < across; ++x) {
      Sample* tile = &strip[static_cast<std::size_t>(x) * kTile * kTile];
      if (band.WriteBlock(x, y, tile) != CE_None)
        input_error("writing failed{}", complaints.text());
    }
  }
}

void write_all(const std::string& path, const Heightfield& field, const SampleFormat& format,
               const GeotiffOptions& options) {
  const Complaints complaints;
  Dataset dataset = created(path, field, format, options, complaints);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  switch (format.type) {
    case GDT_Int16:
      write_tiles<std::int16_t>(band, field, format, complaints);
      break;
    case GDT_UInt16:
      write_tiles<std::uint16_t>(band, field, format, complaints);
      break;
    default:
      write_tiles<float>(band, field, format, complaints);
  }
  dataset.reset();  // the last of it is written here
  if (complaints.has_failures()) input_error("writing failed{}", complaints.text());
}

}  // namespace

void write_geotiff(const std::filesystem::path& path, const Heightfield& field,
                   const GeotiffOptions& options) {
  require_valid(field);
  const SampleFormat format = format_of(options.samples);
  if (options.samples != GeotiffSamples::Float32)
    require_whole_metres(field, format, path.string());
  TemporarySibling sibling(path);
  try {
    write_all(sibling.path().string(), field, format, options);
  } catch (const InputError& error) {
    input_error("cannot write '{}': {}", path.string(), error.what());
  }
  sibling.commit();
}

}  // namespace plumb::terrain
