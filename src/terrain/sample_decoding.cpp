#include "terrain/sample_decoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "terrain/memory_check.h"

namespace plumb::terrain {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
constexpr double kDeepest_m = -12000.0;  // no place on earth lies lower, or higher than the next
constexpr double kHighest_m = 9000.0;

bool fits_float(double value) {
  return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

bool is_no_data(double value, const SampleCoding& coding) {
  for (const auto& no_data : coding.no_data) {
    if (!no_data) continue;
    if (std::isnan(*no_data) ? std::isnan(value) : value == *no_data) return true;
    if (coding.stored_as == SampleType::Float32 && fits_float(*no_data) && fits_float(value) &&
        static_cast<float>(value) == static_cast<float>(*no_data)) {
      return true;
    }
  }
  return false;
}

void add_to(DecodingTally& sum, const DecodingTally& more) {
  sum.voids_declared += more.voids_declared;
  sum.voids_not_finite += more.voids_not_finite;
  sum.beyond_earth += more.beyond_earth;
  sum.largest_rounding_m = std::max(sum.largest_rounding_m, more.largest_rounding_m);
}

std::uint16_t void_code(const HeightCoding& coding) {
  return static_cast<std::uint16_t>(coding.void_code);
}

// The codes of a row of whole numbers of 16 bits, and whether a height among them has the code of a
// void.
bool encode(std::span<const double> stored, std::span<const float> heights_m,
            const HeightCoding& coding, std::span<std::uint16_t> codes) {
  int uses_void_code = 0;  // no branches: for compilers that work in lanes
  for (std::size_t k = 0; k < stored.size(); ++k) {
    const int is_void = std::isnan(heights_m[k]) ? 1 : 0;
    const int code = static_cast<int>(stored[k]) - coding.first;
    codes[k] = static_cast<std::uint16_t>(is_void != 0 ? coding.void_code : code);
    uses_void_code |= (code == coding.void_code ? 1 : 0) & (1 - is_void);
  }
  return uses_void_code != 0;
}

}  // namespace

std::optional<HeightCoding> height_coding(const SampleCoding& coding) {
  if (coding.stored_as != SampleType::Int16 && coding.stored_as != SampleType::Uint16) return {};
  const bool is_signed = coding.stored_as == SampleType::Int16;
  HeightCoding codes{is_signed ? -32768 : 0, coding.scale, coding.offset_m, is_signed ? 0 : 65535};
  for (const auto& no_data : coding.no_data) {
    const double code = no_data ? *no_data - codes.first : -1.0;
    if (code >= 0.0 && code <= 65535.0 && std::floor(code) == code)
      codes.void_code = static_cast<int>(code);
  }
  if (!codes.is_usable()) return {};
  return codes;
}

int bytes_per_sample(const SampleCoding& coding) {
  return static_cast<int>(height_coding(coding) ? sizeof(std::uint16_t) : sizeof(float));
}

DecodingTally decode_samples(std::span<const double> stored, std::span<const std::uint8_t> mask,
                             const SampleCoding& coding, std::span<float> heights_m) {
  DecodingTally tally;
  for (std::size_t k = 0; k < stored.size(); ++k) {
    heights_m[k] = kVoid;
    if ((!mask.empty() && mask[k] == 0) || is_no_data(stored[k], coding)) {
      ++tally.voids_declared;
      continue;
    }
    const double height = stored[k] * coding.scale + coding.offset_m;
    if (!fits_float(height)) {  // false for NaN
      ++tally.voids_not_finite;
      continue;
    }
    heights_m[k] = static_cast<float>(height);
    tally.largest_rounding_m =
        std::max(tally.largest_rounding_m, std::abs(static_cast<double>(heights_m[k]) - height));
    if (height < kDeepest_m || height > kHighest_m) ++tally.beyond_earth;
  }
  return tally;
}

double decode_colour(Decode decode, int red, int green, int blue) {
  const int code = 65536 * red + 256 * green + blue;
  if (decode == Decode::TerrainRgb) return (code - 100000) / 10.0;
  require(decode == Decode::Terrarium, "a colour is decoded as terrain-rgb or terrarium, not as {}",
          name_of(decode));
  return code / 256.0 - 32768.0;
}

SampleCoding with_options(SampleCoding of_file, const ReadOptions& options) {
  of_file.scale *= options.height_scale;
  of_file.offset_m = of_file.offset_m * options.height_scale + options.height_offset_m;
  of_file.no_data[1] = options.no_data;
  return of_file;
}

HeightfieldBuilder::HeightfieldBuilder(const std::string& name, int columns, int rows,
                                       const SampleCoding& coding, bool rows_run_south)
    : name_(name),
      coding_(coding),
      rows_run_south_(rows_run_south),
      columns_(columns),
      rows_(rows),
      codes_coding_(height_coding(coding)) {
  require_memory(name, columns, rows, bytes_per_sample(coding));
  if (codes_coding_) {
    codes_ = Grid<std::uint16_t>(columns, rows, void_code(*codes_coding_));
  } else {
    heights_m_ = Grid<float>(columns, rows, kVoid);
  }
}

void HeightfieldBuilder::add(int first_row, const StoredRows& rows) {
  const auto columns = static_cast<std::size_t>(columns_);
  const std::size_t count = rows.values.size() / columns;
  std::vector<DecodingTally> tallies(count);
  std::vector<std::uint8_t> uses_void_code(count, 0);
  parallel_for(static_cast<std::int64_t>(count), 4, [&](std::int64_t k) {
    const auto row = static_cast<std::size_t>(k);
    const int in_file = first_row + static_cast<int>(k);
    const int in_memory = rows_run_south_ ? rows_ - 1 - in_file : in_file;
    const auto mask = rows.mask.empty() ? rows.mask : rows.mask.subspan(row * columns, columns);
    const auto stored = rows.values.subspan(row * columns, columns);
    std::vector<float> buffer(codes_coding_ ? columns : 0);
    const std::span<float> heights_m = codes_coding_ ? buffer : heights_m_.row(in_memory);
    tallies[row] = decode_samples(stored, mask, coding_, heights_m);
    if (!codes_coding_) return;
    uses_void_code[row] = encode(stored, heights_m, *codes_coding_, codes_.row(in_memory));
  });
  DecodingTally sum = tally_;
  for (const DecodingTally& tally : tallies) add_to(sum, tally);
  const bool used = uses_void_code_ || std::count(uses_void_code.begin(), uses_void_code.end(), 1);
  if (used && sum.voids() > 0) {
    give_up_codes();
    add(first_row, rows);
    return;
  }
  uses_void_code_ = used;
  tally_ = sum;
}

// What was added before holds voids, or heights of the void code, or neither.
void HeightfieldBuilder::give_up_codes() {
  require_memory(name_, columns_, rows_, sizeof(float));
  if (tally_.voids() == 0) codes_coding_->void_code = HeightCoding::kNoVoid;
  HeightGrid heights(std::move(codes_), *codes_coding_);
  heights_m_ = std::move(heights.floats());
  codes_ = {};
  codes_coding_.reset();
  uses_void_code_ = false;
}

Heightfield HeightfieldBuilder::finish() {
  Heightfield field;
  if (codes_coding_) {
    if (tally_.voids() == 0) codes_coding_->void_code = HeightCoding::kNoVoid;
    field.heights_m = HeightGrid(std::move(codes_), *codes_coding_);
  } else {
    field.heights_m = std::move(heights_m_);
  }
  Provenance& provenance = field.provenance;
  provenance.height_scale = coding_.scale;
  provenance.height_offset_m = coding_.offset_m;
  provenance.voids_declared = tally_.voids_declared;
  provenance.voids_not_finite = tally_.voids_not_finite;
  provenance.largest_rounding_m = tally_.largest_rounding_m;
  if (tally_.beyond_earth > 0) {
    provenance.assumptions.push_back(fmt::format(
        "{} samples lie below -12000 m or above 9000 m, as no place on earth does, and were taken "
        "as heights: --nodata makes a stored value void, --height-scale changes the unit",
        tally_.beyond_earth));
  }
  return field;
}

int rows_per_chunk(int columns, int block_rows) {
  constexpr std::int64_t kSamples = 512 * 1024, kMost = 16 * kSamples;
  const std::int64_t width = std::max(1, columns);
  const std::int64_t wanted = std::max<std::int64_t>(1, kSamples / width);
  const std::int64_t most = std::max<std::int64_t>(1, kMost / width);
  const std::int64_t block = std::max(1, block_rows);
  if (block > most) return static_cast<int>(wanted);
  return static_cast<int>((wanted + block - 1) / block * block);
}

}  // namespace plumb::terrain
