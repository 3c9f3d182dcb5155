#include <fmt/format.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <array>
#include <limits>
#include <vector>

#include "core/check.h"
#include "terrain/gdal_dataset.h"

namespace plumb::terrain {
namespace {

struct FreeStrings {
  void operator()(char** list) const { CSLDestroy(list); }
};

/// `field`, whose samples stand as `g` says of `window`, in memory as a dataset of GDAL's.
Dataset in_memory(const Heightfield& field, const FileGeoreference& g, const Window& window,
                  const OGRSpatialReference& crs) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  Dataset dataset(driver->Create("", field.columns(), field.rows(), 1, GDT_Float32, nullptr));
  if (!dataset) return dataset;
  std::array<double, 6> transform = g.transform;
  transform[0] += window.x * transform[1] + window.y * transform[2];
  transform[3] += window.x * transform[4] + window.y * transform[5];
  dataset->SetGeoTransform(transform.data());
  dataset->SetSpatialRef(&crs);
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  std::vector<float> buffer;
  for (int j = 0; j < field.rows(); ++j) {
    const int row = transform[5] < 0.0 ? field.rows() - 1 - j : j;
    auto* heights = const_cast<float*>(field.heights_m.row(j, buffer).data());
    if (band.RasterIO(GF_Write, 0, row, field.columns(), 1, heights, field.columns(), 1,
                      GDT_Float32, 0, 0, nullptr) != CE_None) {
      return nullptr;
    }
  }
  return dataset;
}

/// `source` seen through GDAL's warper in the coordinate system `crs`; reads `source` as it is
/// read.
Dataset warped(GDALDataset& source, const std::string& crs) {
  char** words = nullptr;
  for (const char* word : {"-of", "VRT", "-t_srs", crs.c_str(), "-r", "bilinear"}) {
    words = CSLAddString(words, word);
  }
  const std::unique_ptr<char*, FreeStrings> list(words);
  GDALWarpAppOptions* options = GDALWarpAppOptionsNew(words, nullptr);
  if (!options) return nullptr;
  GDALDatasetH sources[] = {&source};
  Dataset result(static_cast<GDALDataset*>(GDALWarp("", nullptr, 1, sources, options, nullptr)));
  GDALWarpAppOptionsFree(options);
  return result;
}

}  // namespace

Reprojected reproject(const Heightfield& heights, GDALDataset& source, const Window& window,
                      const std::string& crs, const std::string& file,
                      const Complaints& complaints) {
  if (!source.GetSpatialRef()) {
    input_error("{}: it names no coordinate system to reproject from into {}", file, crs);
  }
  OGRSpatialReference wanted;
  if (wanted.SetFromUserInput(crs.c_str()) != OGRERR_NONE) {
    input_error("--crs {}: not a known coordinate system, expected such as EPSG:2056{}", crs,
                complaints.text());
  }
  Reprojected reprojected;
  reprojected.copy = in_memory(heights, georeference_of(source), window, *source.GetSpatialRef());
  if (reprojected.copy) reprojected.result = warped(*reprojected.copy, crs);
  if (!reprojected.result) {
    input_error("{}: cannot be reprojected into {}{}", file, crs, complaints.text());
  }
  return reprojected;
}

}  // namespace plumb::terrain
