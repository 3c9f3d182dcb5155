// Depth buffers from files: a number a pixel, and how finely the file could say it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::image {

/// How numbers lie in a buffer: floats, or even steps.
struct NumberFormat {
  int float_digits = 24;  // binary digits of a float's fraction, the hidden one included: 11 of
                          // half, 24 of single precision
  int step_bits = 0;      // > 0: 2^step_bits - 1 even steps from 0 to 1, and no floats

  friend bool operator==(const NumberFormat&, const NumberFormat&) = default;
};

/// "floats of 24 binary digits", "steps of 1/65535".
std::string to_text(const NumberFormat& format);

/// The numbers that a buffer of this format holds as `value`: from half-way to the one below to
/// half-way to the one above, each as close as the format can tell. `value` is finite; floats may
/// be of any size and sign (zero counts as known to half of the least normal number).
struct NumberRange {
  double low, high;
};
NumberRange numbers_held_as(double value, const NumberFormat& format);

struct DepthBuffer {
  int width_px = 0, height_px = 0;
  std::vector<float> values;  // as stored, row by row in the file's order; of integers 0..1
  NumberFormat format;
  std::string channel;  // its name in the file; empty if the file has no names

  std::size_t size() const { return values.size(); }
};

enum class RawOrder { None, Little, Big };

struct DepthReadOptions {
  std::string channel;            // empty: Z, or the only one
  RawOrder raw = RawOrder::None;  // other than None: single precision and nothing else in the file
  int raw_width_px = 0, raw_height_px = 0;
};

/// Reads EXR, PFM (by its first bytes; its rows, bottom to top in the file, are put in order),
/// TIFF, PNG and whatever else OpenImageIO reads, or raw single precision. Throws InputError, one
/// line with the path, if it cannot be read whole, if the channel is not there (with those that
/// are), and for a raw file of another size.
DepthBuffer read_depth(const std::filesystem::path& path, const DepthReadOptions& options = {});

}  // namespace plumb::image
