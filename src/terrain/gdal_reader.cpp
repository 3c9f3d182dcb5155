#include "terrain/gdal_reader.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/check.h"
#include "terrain/gdal_dataset.h"
#include "terrain/memory_check.h"
#include "terrain/sample_decoding.h"

namespace plumb::terrain {
namespace {

double band_no_data(GDALRasterBand& band, bool& has) {
  int found = 0;
  double value = 0.0;
  if (band.GetRasterDataType() == GDT_Int64) {
    value = static_cast<double>(band.GetNoDataValueAsInt64(&found));
  } else if (band.GetRasterDataType() == GDT_UInt64) {
    value = static_cast<double>(band.GetNoDataValueAsUInt64(&found));
  } else {
    value = band.GetNoDataValue(&found);
  }
  has = found != 0;
  return value;
}

SampleType sample_type(GDALRasterBand& band) {
  switch (band.GetRasterDataType()) {
    case GDT_Byte:
    case GDT_UInt16:
      return SampleType::Uint16;
    case GDT_Int16:
      return SampleType::Int16;
    case GDT_Float32:
      return SampleType::Float32;
    default:
      return SampleType::Other;
  }
}

/// Metres in the band's unit, or in the vertical unit of the file's coordinate system.
double vertical_unit_m(GDALDataset& dataset, GDALRasterBand& band, const std::string& file,
                       std::vector<std::string>& assumptions) {
  const std::string unit = band.GetUnitType() ? band.GetUnitType() : "";
  double metres = metres_in_unit(unit);
  const OGRSpatialReference* crs = dataset.GetSpatialRef();
  if (unit.empty() && crs && crs->IsCompound()) metres = crs->GetTargetLinearUnits("VERT_CS");
  if (metres == 0.0) {
    assumptions.push_back(
        fmt::format("the heights' unit '{}' of {} is unknown and was taken as metres", unit, file));
    return 1.0;
  }
  if (metres != 1.0) {
    assumptions.push_back(
        fmt::format("heights in units of {} m, as the file states them, were made metres", metres));
  }
  return metres;
}

SampleCoding coding_of(GDALDataset& dataset, GDALRasterBand& band, const std::string& file,
                       std::vector<std::string>& assumptions) {
  SampleCoding coding;
  const double unit_m = vertical_unit_m(dataset, band, file, assumptions);
  coding.scale = band.GetScale() * unit_m;
  coding.offset_m = band.GetOffset() * unit_m;
  if (coding.scale == 0.0 || !std::isfinite(coding.scale) || !std::isfinite(coding.offset_m)) {
    input_error("{}: its heights have a scale of {} and an offset of {}", file, coding.scale,
                coding.offset_m);
  }
  bool has = false;
  const double no_data = band_no_data(band, has);
  if (has) coding.no_data[0] = no_data;
  coding.stored_as = sample_type(band);
  return coding;
}

/// What is read of a file: one band, or three that make a colour.
struct Channels {
  std::vector<GDALRasterBand*> bands;
  GDALRasterBand* mask = nullptr;  // hides samples where it is 0
  Decode decode = Decode::Unspecified;
};

bool is_colour(GDALDataset& dataset) {
  const int count = dataset.GetRasterCount();
  if (count != 3 && count != 4) return false;
  for (int band = 1; band <= count; ++band) {
    if (dataset.GetRasterBand(band)->GetRasterDataType() != GDT_Byte) return false;
  }
  return dataset.GetRasterBand(1)->GetColorInterpretation() == GCI_RedBand;
}

Channels channels_of(GDALDataset& dataset, const ReadOptions& options, const std::string& file) {
  const int count = dataset.GetRasterCount();
  Channels channels;
  channels.decode = options.decode;
  const bool decodes = options.decode == Decode::TerrainRgb || options.decode == Decode::Terrarium;
  if (options.decode == Decode::Unspecified && is_colour(dataset)) {
    input_error(
        "{}: a colour image; say how its colours stand for heights: --decode "
        "grey|terrain-rgb|terrarium",
        file);
  }
  if (decodes && (count < 3 || dataset.GetRasterBand(1)->GetRasterDataType() != GDT_Byte)) {
    input_error("{}: {} needs three 8-bit bands, found {} of type {}", file,
                name_of(options.decode), count,
                GDALGetDataTypeName(dataset.GetRasterBand(1)->GetRasterDataType()));
  }
  if (options.band > count) {
    input_error("{}: there is no band {}, the file has {}", file, options.band, count);
  }
  for (int k = 0; k < (decodes ? 3 : 1); ++k) {
    channels.bands.push_back(dataset.GetRasterBand(decodes ? k + 1 : options.band));
  }
  GDALRasterBand& first = *channels.bands.front();
  if (GDALDataTypeIsComplex(first.GetRasterDataType())) {
    input_error("{}: its samples are complex numbers, expected heights", file);
  }
  const int mask = first.GetMaskFlags();
  if ((mask & (GMF_PER_DATASET | GMF_ALPHA)) != 0 && !decodes) channels.mask = first.GetMaskBand();
  return channels;
}

template <class Value>
void read_rows(GDALRasterBand& band, const Window& window, int row, GDALDataType type,
               std::vector<Value>& values, const std::string& file, const Complaints& complaints) {
  const int rows = static_cast<int>(values.size() / static_cast<std::size_t>(window.width));
  if (band.RasterIO(GF_Read, window.x, window.y + row, window.width, rows, values.data(),
                    window.width, rows, type, 0, 0, nullptr) != CE_None) {
    input_error("{}: rows {} to {} cannot be read{}", file, window.y + row,
                window.y + row + rows - 1, complaints.text());
  }
}

/// Rows to read next: a chunk, cut where it would end within a block that the one after needs too.
int rows_in_chunk(const Window& window, int row, int chunk, int block_rows) {
  const int left = std::min(chunk, window.height - row);
  if (block_rows < 1) return left;
  const int into_block = (window.y + row) % block_rows;
  const int to_block_end = block_rows - into_block;
  if (left <= to_block_end) return left;
  return left - (into_block + left) % block_rows;
}

/// GDAL keeps the blocks that it has read, up to a twentieth of the machine's memory; no block is
/// read twice here.
void forget_blocks(const Channels& channels) {
  for (GDALRasterBand* band : channels.bands) band->FlushCache();
  if (channels.mask) channels.mask->FlushCache();
}

/// The heights of a window, with what decoding met in the provenance.
Heightfield read_heights(const Channels& channels, const SampleCoding& coding, const Window& window,
                         bool rows_run_south, const std::string& file,
                         const Complaints& complaints) {
  HeightfieldBuilder builder(file, window.width, window.height, coding, rows_run_south);
  int block_columns = 0, block_rows = 0;
  channels.bands.front()->GetBlockSize(&block_columns, &block_rows);
  const int chunk = rows_per_chunk(window.width, block_rows);
  std::vector<std::vector<double>> values(channels.bands.size());
  std::vector<std::uint8_t> mask;
  for (int row = 0; row < window.height;) {
    const int rows = rows_in_chunk(window, row, chunk, block_rows);
    const auto samples = static_cast<std::size_t>(rows) * static_cast<std::size_t>(window.width);
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k].resize(samples);
      read_rows(*channels.bands[k], window, row, GDT_Float64, values[k], file, complaints);
    }
    if (channels.mask) {
      mask.resize(samples);
      read_rows(*channels.mask, window, row, GDT_Byte, mask, file, complaints);
    }
    if (values.size() == 3) {
      for (std::size_t k = 0; k < samples; ++k) {
        values[0][k] =
            decode_colour(channels.decode, static_cast<int>(values[0][k]),
                          static_cast<int>(values[1][k]), static_cast<int>(values[2][k]));
      }
    }
    builder.add(row, {values[0], mask});
    row += rows;
    if ((window.y + row) % std::max(1, block_rows) == 0) forget_blocks(channels);
  }
  return builder.finish();
}

/// The same terrain on a grid of the coordinate system that the options ask for.
Heightfield read_reprojected(Heightfield field, GDALDataset& source, const Window& window,
                             const ReadOptions& options, const std::string& file,
                             const Complaints& complaints) {
  require_memory(file, field.columns(), field.rows(), sizeof(float));
  const Reprojected reprojected = reproject(field, source, window, options.crs, file, complaints);
  field.heights_m = {};  // the copy has them
  GDALDataset& target = *reprojected.result;
  const Window all{0, 0, target.GetRasterXSize(), target.GetRasterYSize()};
  const Placement placement = place(georeference_of(target), all, options, file);
  SampleCoding coding;
  coding.no_data[0] = std::numeric_limits<double>::quiet_NaN();
  Channels channels;
  channels.bands = {target.GetRasterBand(1)};
  Heightfield result =
      read_heights(channels, coding, all, placement.rows_run_south, file, complaints);
  // Voids are those of the new grid; all else is as it was read.
  field.provenance.voids_declared = result.provenance.voids_declared;
  field.provenance.voids_not_finite = 0;
  field.provenance.assumptions.push_back(
      fmt::format("GDAL's warper resampled the heights (bilinear) from {} into {}: a new grid of "
                  "{} x {} samples, counted from its own corner",
                  field.provenance.crs, options.crs, all.width, all.height));
  field.provenance.crs = options.crs;
  field.provenance.file_columns = all.width;
  field.provenance.file_rows = all.height;
  field.provenance.window_x = field.provenance.window_y = 0;
  result.provenance = std::move(field.provenance);
  settle(result, placement);
  return result;
}

}  // namespace

Heightfield read_with_gdal(const std::string& file, const ReadOptions& options) {
  const Complaints complaints;
  const bool is_unnamed = is_unnamed_hgt(file, options);
  if (options.origin && !is_unnamed) {
    input_error("{}: --origin is for .hgt files whose name does not state it", file);
  }
  const Dataset dataset =
      is_unnamed ? open_unnamed_hgt(file, options) : open_dataset(file, complaints);
  const Channels channels = channels_of(*dataset, options, file);
  const Window window =
      window_in(options, file, dataset->GetRasterXSize(), dataset->GetRasterYSize());
  const FileGeoreference g = georeference_of(*dataset);
  const bool reprojects = !options.crs.empty();
  const Placement placement = reprojects ? Placement{} : place(g, window, options, file);
  const bool south = reprojects ? g.transform[5] < 0.0 : placement.rows_run_south;
  std::vector<std::string> assumptions;
  SampleCoding of_file = coding_of(*dataset, *channels.bands.front(), file, assumptions);
  if (channels.bands.size() > 1) of_file.stored_as = SampleType::Other;  // a colour is no sample
  Heightfield field =
      read_heights(channels, with_options(of_file, options), window, south, file, complaints);
  Provenance& p = field.provenance;
  p.assumptions.insert(p.assumptions.begin(), assumptions.begin(), assumptions.end());
  if (is_unnamed) {
    p.assumptions.insert(p.assumptions.begin(),
                         fmt::format("the south-west sample was taken to stand at longitude {}, "
                                     "latitude {} degrees: the user's origin, not the file's",
                                     options.origin->longitude_deg, options.origin->latitude_deg));
  }
  p.format = is_unnamed ? "SRTMHGT" : dataset->GetDriver()->GetDescription();
  p.file_columns = dataset->GetRasterXSize();
  p.file_rows = dataset->GetRasterYSize();
  p.window_x = window.x;
  p.window_y = window.y;
  p.crs = g.crs;
  if (reprojects)
    return read_reprojected(std::move(field), *dataset, window, options, file, complaints);
  settle(field, placement);
  return field;
}

}  // namespace plumb::terrain
