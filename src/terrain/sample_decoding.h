// From what a file stores to heights in metres.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "terrain/heightfield.h"
#include "terrain/read_options.h"

namespace plumb::terrain {

/// What a file holds its samples as, where that matters.
enum class SampleType {
  Other,
  Float32,  // a no-data value is compared after rounding to this
  Int16,
  Uint16,  // or less: whole numbers in [0, 65535]
};

/// How a stored value becomes a height: value * scale + offset_m, unless it is void.
struct SampleCoding {
  double scale = 1.0;
  double offset_m = 0.0;
  std::array<std::optional<double>, 2> no_data;  // stored values that are void; may be NaN
  SampleType stored_as = SampleType::Other;
};

/// What decoding met. Counts are of samples.
struct DecodingTally {
  std::int64_t voids_declared = 0;    // masked, or equal to a no-data value
  std::int64_t voids_not_finite = 0;  // NaN or infinite, or too large for float32
  std::int64_t beyond_earth = 0;      // below -12000 m or above 9000 m
  double largest_rounding_m = 0.0;    // between the height in double and in float32

  std::int64_t voids() const { return voids_declared + voids_not_finite; }
  friend bool operator==(const DecodingTally&, const DecodingTally&) = default;
};

/// The codes of 16 bits that can hold such heights, voids among them, if any can: the stored values
/// must be whole numbers of 16 bits and none of them stand for a height that a float has not. Their
/// void code is a no-data value, or else the value that is least likely to be a height.
std::optional<HeightCoding> height_coding(const SampleCoding& coding);

/// Bytes that such a height is held in: 2 or 4.
int bytes_per_sample(const SampleCoding& coding);

/// Decodes `stored` into `heights_m` (same length); a sample whose mask is 0 is void (an empty mask
/// hides nothing).
DecodingTally decode_samples(std::span<const double> stored, std::span<const std::uint8_t> mask,
                             const SampleCoding& coding, std::span<float> heights_m);

/// The height that a colour stands for, metres. `decode` is TerrainRgb or Terrarium; channels are
/// 0..255. The result is the double nearest to the exact decimal value.
double decode_colour(Decode decode, int red, int green, int blue);

/// The coding with the user's scale, offset and no-data value on top of the file's own.
SampleCoding with_options(SampleCoding of_file, const ReadOptions& options);

/// One chunk of consecutive rows of a file, as stored. Rows run as in the file.
struct StoredRows {
  std::span<const double> values;      // rows x columns
  std::span<const std::uint8_t> mask;  // the same, or empty
};

/// Collects the rows of a file into a heightfield, whichever way they run. Heights that codes of 16
/// bits can hold are never all there as floats, unless voids come to light that no code is left
/// for.
class HeightfieldBuilder {
 public:
  /// Allocates columns x rows samples, after checking that they fit into memory.
  HeightfieldBuilder(const std::string& name, int columns, int rows, const SampleCoding& coding,
                     bool rows_run_south);

  /// Decodes rows first_row, first_row + 1, ... (counted as in the file, from the window's top), in
  /// parallel.
  void add(int first_row, const StoredRows& rows);

  /// The heights with the tally in their provenance; spacing and origin are the caller's to set.
  Heightfield finish();

 private:
  void give_up_codes();

  std::string name_;
  SampleCoding coding_;
  bool rows_run_south_;
  int columns_, rows_;
  std::optional<HeightCoding> codes_coding_;  // if heights are codes
  Grid<std::uint16_t> codes_;                 // one of these two is empty
  Grid<float> heights_m_;
  bool uses_void_code_ = false;  // for a height
  DecodingTally tally_;
};

/// Fewest rows that are worth a call of a reader: about 4 MiB of doubles, in whole blocks unless
/// one row of those is more than 64 MiB.
int rows_per_chunk(int columns, int block_rows = 1);

}  // namespace plumb::terrain
