// Small elevation files that a test writes for itself, into a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "terrain/terrain_source.h"

namespace plumb::terrain {

/// A folder that is gone with the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// A GeoTIFF of one or more bands. `values` run as the file does: row by row from the north.
struct GeoTiff {
  int columns = 2, rows = 2;
  std::string type = "Float32";  // GDAL's name
  std::vector<double> values;    // columns * rows for each band
  std::optional<std::array<double, 6>> transform = std::array<double, 6>{0, 1, 0, 0, 0, -1};
  std::string crs;  // anything that GDAL understands
  std::optional<double> no_data;
  std::optional<double> scale, offset;
  std::string unit;
  std::vector<std::uint8_t> mask;  // of the dataset; empty: none
  bool is_colour = false;
  std::vector<std::string> creation_options;
};
void write(const std::string& file, const GeoTiff& tiff);

/// An image without georeference; channels interleaved, rows from the north.
void write_png8(const std::string& file, int columns, int rows, int channels,
                const std::vector<std::uint8_t>& values);
void write_png16(const std::string& file, int columns, int rows,
                 const std::vector<std::uint16_t>& values);
void write_exr(const std::string& file, int columns, int rows, const std::vector<float>& values);
void write_bytes(const std::string& file, const std::vector<unsigned char>& bytes);
void write_text(const std::string& file, const std::string& text);

/// The message of the InputError that `action` ends in. Fails the test unless it ends in one, in
/// one line, with nothing on standard error.
std::string input_error_of(const std::function<void()>& action);

/// The heights from the file's top left, row by row.
std::vector<float> as_in_file(const Heightfield& field);

/// True if one of the assumptions contains `words`.
bool assumes(const Heightfield& field, const std::string& words);

}  // namespace plumb::terrain
