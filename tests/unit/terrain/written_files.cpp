#include "written_files.h"

#include <OpenImageIO/imageio.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <fstream>
#include <memory>

#include "core/check.h"

namespace plumb::terrain {
namespace {

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};

void describe(GDALDataset& dataset, const GeoTiff& tiff) {
  auto transform = tiff.transform;
  if (transform) dataset.SetGeoTransform(transform->data());
  if (!tiff.crs.empty()) {
    OGRSpatialReference crs;
    ASSERT_EQ(crs.SetFromUserInput(tiff.crs.c_str()), OGRERR_NONE);
    dataset.SetSpatialRef(&crs);
  }
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  if (tiff.no_data) band.SetNoDataValue(*tiff.no_data);
  if (tiff.scale) band.SetScale(*tiff.scale);
  if (tiff.offset) band.SetOffset(*tiff.offset);
  if (!tiff.unit.empty()) band.SetUnitType(tiff.unit.c_str());
}

void write_image(const std::string& file, OIIO::ImageSpec spec, const void* values) {
  spec.attribute("oiio:UnassociatedAlpha", 1);
  auto output = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(output && output->open(file, spec));
  ASSERT_TRUE(output->write_image(spec.format, values));
  ASSERT_TRUE(output->close());
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "plumb-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void write(const std::string& file, const GeoTiff& tiff) {
  GDALAllRegister();
  const auto samples = static_cast<std::size_t>(tiff.columns) * static_cast<std::size_t>(tiff.rows);
  const int bands = static_cast<int>(tiff.values.size() / samples);
  char** options = nullptr;
  for (const std::string& option : tiff.creation_options) {
    options = CSLAddString(options, option.c_str());
  }
  if (tiff.is_colour) options = CSLAddString(options, "PHOTOMETRIC=RGB");
  CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
  std::unique_ptr<GDALDataset, CloseDataset> dataset(
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
          file.c_str(), tiff.columns, tiff.rows, bands, GDALGetDataTypeByName(tiff.type.c_str()),
          options));
  CSLDestroy(options);
  ASSERT_TRUE(dataset);
  describe(*dataset, tiff);
  for (int band = 0; band < bands; ++band) {
    auto* values =
        const_cast<double*>(tiff.values.data() + static_cast<std::size_t>(band) * samples);
    ASSERT_EQ(dataset->GetRasterBand(band + 1)->RasterIO(GF_Write, 0, 0, tiff.columns, tiff.rows,
                                                         values, tiff.columns, tiff.rows,
                                                         GDT_Float64, 0, 0, nullptr),
              CE_None);
  }
  if (!tiff.mask.empty()) {
    ASSERT_EQ(dataset->CreateMaskBand(GMF_PER_DATASET), CE_None);
    auto* mask = const_cast<std::uint8_t*>(tiff.mask.data());
    ASSERT_EQ(dataset->GetRasterBand(1)->GetMaskBand()->RasterIO(
                  GF_Write, 0, 0, tiff.columns, tiff.rows, mask, tiff.columns, tiff.rows, GDT_Byte,
                  0, 0, nullptr),
              CE_None);
  }
}

void write_png8(const std::string& file, int columns, int rows, int channels,
                const std::vector<std::uint8_t>& values) {
  write_image(file, OIIO::ImageSpec(columns, rows, channels, OIIO::TypeDesc::UINT8), values.data());
}

void write_png16(const std::string& file, int columns, int rows,
                 const std::vector<std::uint16_t>& values) {
  write_image(file, OIIO::ImageSpec(columns, rows, 1, OIIO::TypeDesc::UINT16), values.data());
}

void write_exr(const std::string& file, int columns, int rows, const std::vector<float>& values) {
  write_image(file, OIIO::ImageSpec(columns, rows, 1, OIIO::TypeDesc::FLOAT), values.data());
}

void write_bytes(const std::string& file, const std::vector<unsigned char>& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

void write_text(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string input_error_of(const std::function<void()>& action) {
  testing::internal::CaptureStderr();
  std::string message;
  bool thrown = false;
  try {
    action();
  } catch (const InputError& error) {
    message = error.what();
    thrown = true;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another exception: " << error.what();
  }
  const std::string second_voice = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(thrown) << "no InputError";
  EXPECT_EQ(second_voice, "");
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message;
}

std::vector<float> as_in_file(const Heightfield& field) {
  std::vector<float> values;
  std::vector<float> buffer;
  for (int j = field.rows() - 1; j >= 0; --j) {
    const auto row = field.heights_m.row(j, buffer);
    values.insert(values.end(), row.begin(), row.end());
  }
  return values;
}

bool assumes(const Heightfield& field, const std::string& words) {
  for (const std::string& line : field.provenance.assumptions) {
    if (line.find(words) != std::string::npos) return true;
  }
  return false;
}

}  // namespace plumb::terrain
