// SRTM tiles whose file name does not say where they lie.
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/check.h"
#include "terrain/gdal_dataset.h"
#include "terrain/memory_check.h"

namespace plumb::terrain {
namespace {

constexpr std::array<int, 2> kSides{1201, 3601};  // samples: three seconds apart, and one
constexpr std::int16_t kVoid = -32768;

constexpr std::uintmax_t bytes_of(int side) {
  return 2 * static_cast<std::uintmax_t>(side) * static_cast<std::uintmax_t>(side);
}

/// Samples along a side of a tile that takes so many bytes; 0 if none does.
int side_of(std::uintmax_t bytes) {
  for (const int side : kSides) {
    if (bytes == bytes_of(side)) return side;
  }
  return 0;
}

bool is_called_hgt(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".hgt";
}

/// Rows of big-endian samples, from the north.
void copy_rows(GDALRasterBand& band, int side, const std::string& file) {
  std::ifstream input(file, std::ios::binary);
  std::vector<unsigned char> bytes(2 * static_cast<std::size_t>(side));
  std::vector<std::int16_t> row(static_cast<std::size_t>(side));
  for (int j = 0; j < side; ++j) {
    if (!input.read(reinterpret_cast<char*>(bytes.data()),
                    static_cast<std::streamsize>(bytes.size()))) {
      input_error("{}: row {} cannot be read", file, j);
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = static_cast<std::int16_t>((bytes[2 * i] << 8) | bytes[2 * i + 1]);
    }
    require(band.RasterIO(GF_Write, 0, j, side, 1, row.data(), side, 1, GDT_Int16, 0, 0, nullptr) ==
                CE_None,
            "GDAL cannot write into its own memory");
  }
}

}  // namespace

bool is_unnamed_hgt(const std::string& file, const ReadOptions& options) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) return false;
  const std::uintmax_t bytes = std::filesystem::file_size(file, failed);
  if (failed || !(is_called_hgt(file) || options.origin || side_of(bytes) > 0)) return false;
  register_formats();
  return GDALIdentifyDriverEx(file.c_str(), GDAL_OF_RASTER, nullptr, nullptr) == nullptr;
}

Dataset open_unnamed_hgt(const std::string& file, const ReadOptions& options) {
  const std::uintmax_t bytes = std::filesystem::file_size(file);
  const int side = side_of(bytes);
  if (side == 0) {
    input_error(
        "{}: an .hgt file has {} bytes (1201 x 1201 samples) or {} (3601 x 3601), this one has {}",
        file, bytes_of(kSides[0]), bytes_of(kSides[1]), bytes);
  }
  if (!options.origin) {
    input_error(
        "{}: the name of this .hgt file does not state its corner, as N46E008.hgt does; give its "
        "south-west sample with --origin LON,LAT in degrees",
        file);
  }
  require_memory(file, side, side, sizeof(std::int16_t));
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  Dataset dataset(driver->Create("", side, side, 1, GDT_Int16, nullptr));
  if (!dataset) input_error("{}: there is not enough memory for it", file);
  // A pixel is an area around its sample, so the outermost reach half a step beyond the degree.
  const double step = 1.0 / (side - 1), half = 0.5 / (side - 1);
  std::array<double, 6> transform{options.origin->longitude_deg - half,    step, 0.0,
                                  options.origin->latitude_deg + 1 + half, 0.0,  -step};
  dataset->SetGeoTransform(transform.data());
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  dataset->SetSpatialRef(&wgs84);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  band.SetNoDataValue(kVoid);
  copy_rows(band, side, file);
  return dataset;
}

}  // namespace plumb::terrain
