#include "terrain/gdal_dataset.h"

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>
#include <mutex>

#include "core/check.h"

namespace plumb::terrain {
namespace {

void CPL_STDCALL collect(CPLErr kind, CPLErrorNum, const char* message) {
  if (kind != CE_Warning && kind != CE_Failure && kind != CE_Fatal) return;
  static_cast<Complaints*>(CPLGetErrorHandlerUserData())->add(message, kind == CE_Warning);
}

bool is_mercator(const OGRSpatialReference& crs) {
  const char* projection = crs.GetAttrValue("PROJECTION");
  if (!projection) return false;
  const std::string name = projection;
  return name == SRS_PT_MERCATOR_1SP || name == SRS_PT_MERCATOR_2SP ||
         name == "Popular_Visualisation_Pseudo_Mercator" ||
         name == SRS_PT_MERCATOR_AUXILIARY_SPHERE;
}

std::string name_of(const OGRSpatialReference& crs) {
  const char* authority = crs.GetAuthorityName(nullptr);
  const char* code = crs.GetAuthorityCode(nullptr);
  if (authority && code) return fmt::format("{}:{}", authority, code);
  return crs.GetName() ? crs.GetName() : "";
}

}  // namespace

Complaints::Complaints() { CPLPushErrorHandlerEx(&collect, this); }
Complaints::~Complaints() { CPLPopErrorHandler(); }

void Complaints::add(const std::string& message, bool is_warning) {
  std::string& text = is_warning ? warnings_ : failures_;
  constexpr std::size_t kEnough = 400;
  if (text.size() > kEnough || text.find(message) != std::string::npos) return;
  if (!text.empty()) text += "; ";
  for (const char c : message) text += c == '\n' || c == '\r' ? ' ' : c;
}

std::string Complaints::text() const {
  const std::string& said = failures_.empty() ? warnings_ : failures_;
  return said.empty() ? said : fmt::format(" (GDAL: {})", said);
}

void CloseDataset::operator()(GDALDataset* dataset) const { GDALClose(dataset); }

void register_formats() {
  static std::once_flag registered;
  std::call_once(registered, [] { GDALAllRegister(); });
}

Dataset open_dataset(const std::string& file, const Complaints& complaints) {
  register_formats();
  constexpr unsigned kFlags = GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
  const auto open = [&](const char* const* options) {
    return Dataset(
        static_cast<GDALDataset*>(GDALOpenEx(file.c_str(), kFlags, nullptr, options, nullptr)));
  };
  Dataset dataset = open(nullptr);
  // GDAL looks at the numbers of a text grid and may settle for a type that has no NaN or infinity.
  constexpr std::array<const char*, 2> kInDouble{"DATATYPE=Float64", nullptr};
  if (dataset && dataset->GetDriver()->GetDescription() == std::string("AAIGrid"))
    dataset = open(kInDouble.data());
  if (!dataset) {
    input_error("{}: no elevation file that can be read{}", file, complaints.text());
  }
  if (dataset->GetRasterCount() == 0) {
    const char* first = dataset->GetMetadataItem("SUBDATASET_1_NAME", "SUBDATASETS");
    input_error("{}: it holds no raster of its own{}", file,
                first ? fmt::format("; name one of those in it, such as {}", first) : "");
  }
  return dataset;
}

void describe(const OGRSpatialReference& crs, FileGeoreference& g) {
  g.crs = name_of(crs);
  OGRErr error = OGRERR_NONE;
  g.semi_major_m = crs.GetSemiMajor(&error);
  g.inverse_flattening = crs.GetInvFlattening();
  if (crs.IsGeographic()) {
    g.frame = Frame::Geographic;
    const double radians_per_unit = crs.GetAngularUnits();
    const double degree = CPLAtof(SRS_UA_DEGREE_CONV);
    // The stored conversion of a degree is rounded here or there; a degree is exactly one.
    if (std::abs(radians_per_unit / degree - 1.0) > 1e-9) {
      g.degrees_per_unit = radians_per_unit / degree;
    }
  } else if (crs.IsProjected() || crs.IsLocal()) {
    g.frame = is_mercator(crs) ? Frame::Mercator : Frame::Projected;
    g.metres_per_unit = crs.GetLinearUnits();
  }
}

FileGeoreference georeference_of(GDALDataset& dataset) {
  FileGeoreference g;
  g.has_transform = dataset.GetGeoTransform(g.transform.data()) == CE_None;
  if (const OGRSpatialReference* crs = dataset.GetSpatialRef()) describe(*crs, g);
  return g;
}

}  // namespace plumb::terrain
