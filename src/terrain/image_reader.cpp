#include "terrain/image_reader.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/check.h"
#include "core/png_file.h"
#include "terrain/file_parts.h"
#include "terrain/georeference.h"
#include "terrain/memory_check.h"
#include "terrain/sample_decoding.h"

namespace plumb::terrain {
namespace {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? text : fmt::format(" (OpenImageIO: {})", text);
}

/// An open image and, of a PNG, the parts of the file that it is read from.
struct Input {
  std::unique_ptr<FileParts> parts;
  std::unique_ptr<OIIO::ImageInput> image;  // goes first

  const OIIO::ImageSpec& spec() const { return image->spec(); }
};

bool is_open_exr(const std::string& file) {
  char magic[4] = {};
  return std::ifstream(file, std::ios::binary).read(magic, 4) &&
         std::equal(magic, magic + 4, "\x76\x2f\x31\x01");
}

bool decodes_colour(const ReadOptions& options) {
  return options.decode == Decode::TerrainRgb || options.decode == Decode::Terrarium;
}

/// Refuses a PNG that does not fit into memory, before a decoder asks for any.
void require_memory_for(const PngFile& png, const ReadOptions& options, const std::string& file) {
  const Window window = window_in(options, file, png.columns, png.rows);
  SampleCoding of_file;
  if (!decodes_colour(options)) of_file.stored_as = SampleType::Uint16;
  const int bytes = bytes_per_sample(with_options(of_file, options));
  require_memory(file, window.width, window.height, bytes);
  if (png.interlaced_bytes > 0) {
    require_memory(file, png.columns, png.rows, bytes + png.interlaced_bytes);
  }
}

Input open(const std::string& file, const ReadOptions& options) {
  OIIO::ImageSpec configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);
  Input input;
  if (!is_open_exr(file)) {
    const PngFile png = check_png(file);
    require_memory_for(png, options, file);
    input.parts = std::make_unique<FileParts>(file, png.parts);
  }
  input.image = OIIO::ImageInput::open(file, &configuration, input.parts.get());
  if (!input.image) {
    input_error("{}: no image that can be read{}", file, one_line(OIIO::geterror()));
  }
  return input;
}

/// Which channels make a height.
struct Channels {
  std::vector<int> heights;  // one, or red, green and blue
  int alpha = -1;
};

Channels channels_of(const OIIO::ImageSpec& spec, const ReadOptions& options,
                     const std::string& file) {
  const bool decodes = decodes_colour(options);
  if (options.decode == Decode::Unspecified && spec.nchannels >= 3) {
    input_error(
        "{}: a colour image of {} channels; say how its colours stand for heights: "
        "--decode grey|terrain-rgb|terrarium",
        file, spec.nchannels);
  }
  if (decodes && (spec.nchannels < 3 || spec.format.basetype != OIIO::TypeDesc::UINT8)) {
    input_error("{}: {} needs three 8-bit channels, found {} of type {}", file,
                name_of(options.decode), spec.nchannels, spec.format.c_str());
  }
  if (options.band > spec.nchannels) {
    input_error("{}: there is no channel {}, the image has {}", file, options.band, spec.nchannels);
  }
  Channels channels;
  channels.alpha = spec.alpha_channel;
  if (decodes) {
    channels.heights = {0, 1, 2};
  } else {
    channels.heights = {options.band - 1};
  }
  return channels;
}

/// Rows as stored, all channels interleaved.
template <class Stored>
class Rows {
 public:
  Rows(Input input, const Window& window, const std::string& file)
      : input_(std::move(input)), window_(window), file_(file) {}

  void read(int row, int count) {
    const OIIO::ImageSpec& spec = input_.spec();
    const auto width = static_cast<std::size_t>(spec.width);
    pixels_.resize(width * static_cast<std::size_t>(count) *
                   static_cast<std::size_t>(spec.nchannels));
    const int y = spec.y + window_.y + row;
    if (!input_.image->read_scanlines(0, 0, y, y + count, 0, 0, spec.nchannels,
                                      OIIO::TypeDesc(OIIO::BaseTypeFromC<Stored>::value),
                                      pixels_.data())) {
      input_error("{}: rows {} to {} cannot be read{}", file_, window_.y + row,
                  window_.y + row + count - 1, one_line(input_.image->geterror()));
    }
  }

  Stored at(int i, int row, int channel) const {
    const OIIO::ImageSpec& spec = input_.spec();
    const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(spec.width) +
                       static_cast<std::size_t>(window_.x + i);
    return pixels_[pixel * static_cast<std::size_t>(spec.nchannels) +
                   static_cast<std::size_t>(channel)];
  }

  const OIIO::ImageSpec& spec() const { return input_.spec(); }

 private:
  Input input_;
  Window window_;
  std::string file_;
  std::vector<Stored> pixels_;
};

template <class Stored>
bool is_empty_pixel(const Rows<Stored>& rows, int i, int row, int alpha) {
  for (int channel = 0; channel < rows.spec().nchannels; ++channel) {
    if (rows.at(i, row, channel) != Stored(0)) return false;
  }
  return alpha >= 0;
}

template <class Stored>
Heightfield read_heights(Rows<Stored> rows, const Channels& channels, const ReadOptions& options,
                         const Window& window, const std::string& file) {
  SampleCoding of_file;
  if (std::is_integral_v<Stored> && channels.heights.size() == 1)
    of_file.stored_as = SampleType::Uint16;
  HeightfieldBuilder builder(file, window.width, window.height, with_options(of_file, options),
                             true);
  const int chunk = rows_per_chunk(rows.spec().width);
  std::vector<double> values;
  std::vector<std::uint8_t> mask;
  for (int first = 0; first < window.height; first += chunk) {
    const int count = std::min(chunk, window.height - first);
    rows.read(first, count);
    values.clear();
    mask.clear();
    for (int row = 0; row < count; ++row) {
      for (int i = 0; i < window.width; ++i) {
        const auto channel = [&](std::size_t k) { return rows.at(i, row, channels.heights[k]); };
        mask.push_back(is_empty_pixel(rows, i, row, channels.alpha) ? 0 : 255);
        values.push_back(channels.heights.size() == 1
                             ? static_cast<double>(channel(0))
                             : decode_colour(options.decode, static_cast<int>(channel(0)),
                                             static_cast<int>(channel(1)),
                                             static_cast<int>(channel(2))));
      }
    }
    builder.add(first, {values, mask});
  }
  return builder.finish();
}

Heightfield read_as_stored(Input input, const Channels& channels, const ReadOptions& options,
                           const Window& window, const std::string& file) {
  switch (input.spec().format.basetype) {
    case OIIO::TypeDesc::UINT8:
      return read_heights(Rows<std::uint8_t>(std::move(input), window, file), channels, options,
                          window, file);
    case OIIO::TypeDesc::UINT16:
      return read_heights(Rows<std::uint16_t>(std::move(input), window, file), channels, options,
                          window, file);
    case OIIO::TypeDesc::HALF:
    case OIIO::TypeDesc::FLOAT:
      return read_heights(Rows<float>(std::move(input), window, file), channels, options, window,
                          file);
    default:
      input_error("{}: samples of type {} are not read, expected 8 or 16 bits, half or float", file,
                  input.spec().format.c_str());
  }
}

}  // namespace

Heightfield read_image(const std::string& file, const ReadOptions& options) {
  if (!options.crs.empty()) {
    input_error("{}: an image names no coordinate system to reproject from into {}", file,
                options.crs);
  }
  Input input = open(file, options);
  const OIIO::ImageSpec spec = input.spec();
  const std::string format = input.image->format_name();
  if (spec.tile_width != 0 || spec.depth > 1) {
    input_error("{}: tiled and deep images are not read, expected rows of pixels", file);
  }
  const Channels channels = channels_of(spec, options, file);
  const Window window = window_in(options, file, spec.width, spec.height);
  const Placement placement = place({}, window, options, file);
  Heightfield field = read_as_stored(std::move(input), channels, options, window, file);
  Provenance& p = field.provenance;
  p.format = format == "png" ? "PNG" : format;
  p.file_columns = spec.width;
  p.file_rows = spec.height;
  p.window_x = window.x;
  p.window_y = window.y;
  if (spec.nchannels > 1 && channels.heights.size() == 1) {
    p.assumptions.push_back(
        fmt::format("channel {} of {} was taken as the height", options.band, spec.nchannels));
  }
  settle(field, placement);
  return field;
}

}  // namespace plumb::terrain
