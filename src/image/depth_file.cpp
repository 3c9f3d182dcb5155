#include "image/depth_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/check.h"
#include "image/plane_image.h"

namespace plumb::image {
namespace fs = std::filesystem;
namespace {

constexpr int kLargestSide_px = 65536;

// A file's bytes from `begin` on as floats of that order.
std::vector<float> floats_of(const std::string& bytes, std::size_t begin, std::size_t count,
                             bool big_endian) {
  std::vector<float> values(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::uint32_t word = 0;
    for (std::size_t b = 0; b < 4; ++b) {
      const auto byte = static_cast<unsigned char>(bytes[begin + 4 * k + b]);
      word |= static_cast<std::uint32_t>(byte) << (8 * (big_endian ? 3 - b : b));
    }
    values[k] = std::bit_cast<float>(word);
  }
  return values;
}

std::string bytes_of(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) input_error("cannot read '{}': it is a folder", path.string());
  std::ifstream input(path, std::ios::binary);
  if (!input) input_error("cannot read '{}': {}", path.string(), std::strerror(errno));
  std::ostringstream text;
  text << input.rdbuf();
  if (input.bad()) input_error("cannot read '{}': {}", path.string(), std::strerror(errno));
  return std::move(text).str();
}

DepthBuffer read_raw(const fs::path& path, const DepthReadOptions& options) {
  require(options.raw_width_px >= 1 && options.raw_height_px >= 1,
          "a raw depth buffer needs a size, got {} x {}", options.raw_width_px,
          options.raw_height_px);
  DepthBuffer buffer{options.raw_width_px, options.raw_height_px, {}, {}, {}};
  const std::size_t count = static_cast<std::size_t>(buffer.width_px) * buffer.height_px;
  std::error_code error;
  const auto there = fs::is_directory(path, error) ? 0 : fs::file_size(path, error);
  if (!error && there != 4 * count)
    input_error("cannot read '{}': {} x {} floats are {} bytes, the file has {}", path.string(),
                buffer.width_px, buffer.height_px, 4 * count, there);
  const std::string bytes = bytes_of(path);
  if (bytes.size() != 4 * count) input_error("cannot read '{}': it is cut short", path.string());
  buffer.values = floats_of(bytes, 0, count, options.raw == RawOrder::Big);
  return buffer;
}

bool is_pfm(const fs::path& path) {
  char head[3] = {};
  std::ifstream(path, std::ios::binary).read(head, 3);
  return head[0] == 'P' && (head[1] == 'f' || head[1] == 'F') &&
         (head[2] == '\n' || head[2] == '\r' || head[2] == ' ' || head[2] == '\t');
}

// Portable float maps: a line each of kind, size and scale (its sign is the order of bytes, its
// size says nothing about the numbers), then rows from the bottom.
DepthBuffer read_pfm(const fs::path& path) {
  const std::string bytes = bytes_of(path);
  std::istringstream head(bytes);
  head.imbue(std::locale::classic());
  std::string kind;
  int width = 0, height = 0;
  double scale = 0.0;
  head >> kind >> width >> height >> scale;
  const auto at = head.tellg();
  if (!head || at < 0 || width < 1 || height < 1 || width > kLargestSide_px ||
      height > kLargestSide_px || scale == 0.0)
    input_error("cannot read '{}': expected a PFM file's kind, size and scale in its first lines",
                path.string());
  const std::size_t begin = static_cast<std::size_t>(at) + 1, stride = kind == "PF" ? 3 : 1;
  const std::size_t row = static_cast<std::size_t>(width), count = row * height;
  if (bytes.size() != begin + 4 * count * stride)
    input_error("cannot read '{}': {} x {} pixels are {} bytes, behind its header there are {}",
                path.string(), width, height, 4 * count * stride,
                bytes.size() < begin ? 0 : bytes.size() - begin);
  if (stride != 1)
    input_error("cannot read '{}': it is a colour PFM file, expected one number a pixel (Pf)",
                path.string());
  const std::vector<float> stored = floats_of(bytes, begin, count, scale > 0.0);
  DepthBuffer buffer{width, height, std::vector<float>(count), {}, {}};
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    const std::size_t from = (static_cast<std::size_t>(height) - 1 - y) * row;
    std::copy_n(stored.begin() + static_cast<std::ptrdiff_t>(from), row,
                buffer.values.begin() + static_cast<std::ptrdiff_t>(y * row));
  }
  return buffer;
}

const Plane& chosen_plane(const PlaneImage& image, const fs::path& path,
                          const std::string& channel) {
  std::string names;
  for (const Plane& plane : image.planes) names += (names.empty() ? "" : ", ") + plane.name;
  if (!channel.empty()) {
    if (const Plane* plane = image.find(channel)) return *plane;
    input_error("'{}' has no channel '{}': it has {}", path.string(), channel, names);
  }
  if (image.planes.size() == 1) return image.planes.front();
  if (const Plane* plane = image.find("Z")) return *plane;
  input_error("'{}' has no channel Z and more than one other: name one of {} (--depth-channel)",
              path.string(), names);
}

}  // namespace

std::string to_text(const NumberFormat& format) {
  if (format.step_bits > 0)
    return fmt::format("steps of 1/{}", (std::uint64_t{1} << format.step_bits) - 1);
  return fmt::format("floats of {} binary digits", format.float_digits);
}

NumberRange numbers_held_as(double value, const NumberFormat& format) {
  if (format.step_bits > 0) {
    const auto steps = static_cast<double>((std::uint64_t{1} << format.step_bits) - 1);
    // The number was a float before it became a step, or became one after.
    const double half = 0.5 / steps + std::ldexp(1.0, -25);
    return {value - half, value + half};
  }
  if (value == 0.0) {
    const double half_least =
        0.5 * (format.float_digits <= 11 ? std::ldexp(1.0, -14)
                                         : double{std::numeric_limits<float>::min()});
    return {-half_least, half_least};
  }
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);  // 1/2 <= |fraction| < 1
  const double half_ulp = std::ldexp(1.0, exponent - format.float_digits - 1);
  // Below a power of two floats lie twice as close.
  const double inward = std::abs(fraction) == 0.5 ? 0.5 * half_ulp : half_ulp;
  return value > 0.0 ? NumberRange{value - inward, value + half_ulp}
                     : NumberRange{value - half_ulp, value + inward};
}

DepthBuffer read_depth(const fs::path& path, const DepthReadOptions& options) {
  if (options.raw != RawOrder::None) return read_raw(path, options);
  if (is_pfm(path)) {
    if (!options.channel.empty())
      input_error("'{}' has no channel '{}': a PFM file's has no name", path.string(),
                  options.channel);
    return read_pfm(path);
  }
  PlaneImage image = read_planes(path);
  const Plane& plane = chosen_plane(image, path, options.channel);
  DepthBuffer buffer{image.width_px, image.height_px, plane.values, {}, plane.name};
  buffer.format.float_digits = plane.float_digits;
  buffer.format.step_bits = image.bits;
  return buffer;
}

}  // namespace plumb::image
