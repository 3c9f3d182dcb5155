// Images from files.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/check.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/png_file.h"
#include "image/file_words.h"
#include "image/image_files.h"
#include "image/plane_image.h"
#include "image/srgb.h"

namespace plumb::image {
namespace fs = std::filesystem;
namespace {

// A library's complaint as a part of one line.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "no cause given" : text;
}

}  // namespace

void cannot(const char* verb, const fs::path& path, const std::string& cause) {
  input_error("cannot {} '{}': {}", verb, path.string(), one_line(cause));
}

namespace {

// An open image and, of a PNG, the bytes that it is read from.
struct Input {
  std::vector<unsigned char> bytes;
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> image;  // goes first

  OIIO::ImageInput* operator->() const { return image.get(); }
  OIIO::ImageInput& operator*() const { return *image; }
};

bool is_png(const fs::path& path) {
  unsigned char magic[4] = {};
  return std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(magic), 4) &&
         magic[0] == 0x89 && magic[1] == 'P' && magic[2] == 'N' && magic[3] == 'G';
}

// What a PNG's pixels are made from, checked, so that libpng has nothing to complain of on standard
// error.
std::vector<unsigned char> png_parts(const fs::path& path) {
  const PngFile png = check_png(path.string());
  std::ifstream file(path, std::ios::binary);
  std::vector<unsigned char> bytes;
  for (const FilePart& part : png.parts) {
    const std::size_t at = bytes.size();
    bytes.resize(at + static_cast<std::size_t>(part.size));
    file.seekg(static_cast<std::streamoff>(part.at));
    if (!file.read(reinterpret_cast<char*>(&bytes[at]), static_cast<std::streamsize>(part.size)))
      cannot("read", path, "it changed while it was read");
  }
  return bytes;
}

Input open(const fs::path& path) {
  OIIO::ImageSpec configuration;
  configuration["oiio:UnassociatedAlpha"] = 1;
  Input input;
  if (is_png(path)) {
    input.bytes = png_parts(path);
    input.memory =
        std::make_unique<OIIO::Filesystem::IOMemReader>(input.bytes.data(), input.bytes.size());
  }
  input.image = OIIO::ImageInput::open(path.string(), &configuration, input.memory.get());
  if (!input.image) cannot("read", path, OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1) {
    cannot("read", path,
           fmt::format("{} x {} x {} pixels of {} channels are no picture", spec.width, spec.height,
                       spec.depth, spec.nchannels));
  }
  const auto numbers = static_cast<std::int64_t>(spec.width) * spec.height * spec.nchannels;
  constexpr std::int64_t kBytesNumber = 8;  // as stored, and as a float
  require_memory(kBytesNumber * numbers, fmt::format("'{}'", path.string()));
  return input;
}

void require_whole_picture(const OIIO::ImageSpec& spec, const fs::path& path) {
  if (spec.x == spec.full_x && spec.y == spec.full_y && spec.width == spec.full_width &&
      spec.height == spec.full_height) {
    return;
  }
  cannot("read", path,
         fmt::format("its data window of {} x {} pixels is not its whole picture of {} x {}",
                     spec.width, spec.height, spec.full_width, spec.full_height));
}

template <class T>
std::vector<T> read_pixels(OIIO::ImageInput& input, const fs::path& path, OIIO::TypeDesc type) {
  const OIIO::ImageSpec& spec = input.spec();
  const int channel_count = spec.nchannels;
  std::vector<T> pixels(static_cast<std::size_t>(spec.width) * spec.height * channel_count);
  if (!input.read_image(0, 0, 0, channel_count, type, pixels.data())) {
    cannot("read", path, input.geterror());
  }
  return pixels;
}

std::map<std::string, MetadataValue> get_metadata(const OIIO::ImageSpec& spec) {
  std::map<std::string, MetadataValue> metadata;
  const std::string prefix = kMetadataPrefix;
  for (const OIIO::ParamValue& entry : spec.extra_attribs) {
    const std::string name = entry.name().string();
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    MetadataValue& value = metadata[name.substr(prefix.size())];
    if (entry.type() == OIIO::TypeDesc::DOUBLE) {
      value = *static_cast<const double*>(entry.data());
    } else if (entry.type() == OIIO::TypeDesc::INT) {
      value = *static_cast<const std::int32_t*>(entry.data());
    } else {
      value = entry.get_string();
    }
  }
  return metadata;
}

// Red, green and blue of a file's channels: the first three, or grey thrice.
template <class T, class Put>
void for_each_rgb(const std::vector<T>& pixels, int channel_count, const Put& put) {
  const auto stride = static_cast<std::size_t>(channel_count);
  const std::size_t green = channel_count >= 3 ? 1 : 0, blue = channel_count >= 3 ? 2 : 0;
  for (std::size_t k = 0; k * stride < pixels.size(); ++k) {
    const T* pixel = pixels.data() + k * stride;
    put(k, pixel[0], pixel[green], pixel[blue]);
  }
}

}  // namespace

AovImage read_exr(const fs::path& path) {
  const auto input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  require_whole_picture(spec, path);
  AovImage image;
  image.width_px = spec.width;
  image.height_px = spec.height;
  image.metadata = get_metadata(spec);
  const auto pixels = read_pixels<float>(*input, path, OIIO::TypeDesc::FLOAT);
  bool any = false;
  for (const Channel& channel : channels()) {
    const auto stride = static_cast<std::size_t>(spec.nchannels);
    for (std::size_t c = 0; c < stride; ++c) {
      if (spec.channelnames[c] != channel.name) continue;
      std::vector<float>& values = image.*channel.values;
      values.resize(image.size());
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = pixels[k * stride + c];
      any = true;
    }
  }
  if (!any) cannot("read", path, "none of its channels is one of R G B Z P N id lod overdraw");
  return image;
}

Rgb8Image read_png(const fs::path& path) {
  const auto input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.format != OIIO::TypeDesc::UINT8) {
    cannot("read", path, fmt::format("expected 8 bits a channel, got {}", spec.format.c_str()));
  }
  Rgb8Image image{spec.width, spec.height, {}};
  image.rgb.resize(static_cast<std::size_t>(spec.width) * spec.height * 3);
  const auto pixels = read_pixels<std::uint8_t>(*input, path, OIIO::TypeDesc::UINT8);
  for_each_rgb(pixels, spec.nchannels,
               [&](std::size_t k, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
                 image.rgb[3 * k] = r;
                 image.rgb[3 * k + 1] = g;
                 image.rgb[3 * k + 2] = b;
               });
  return image;
}

ColourImage read_colour(const fs::path& path) {
  const auto input = open(path);
  const OIIO::ImageSpec& spec = input->spec();
  const bool linear = spec.format.is_floating_point();
  ColourImage image(spec.width, spec.height);
  const auto pixels = read_pixels<float>(*input, path, OIIO::TypeDesc::FLOAT);
  const auto light = [linear](float value) {
    return linear ? value : static_cast<float>(srgb_to_linear(double{value}));
  };
  for_each_rgb(pixels, spec.nchannels, [&](std::size_t k, float r, float g, float b) {
    image.r[k] = light(r);
    image.g[k] = light(g);
    image.b[k] = light(b);
  });
  return image;
}

PlaneImage read_planes(const fs::path& path) {
  const auto input = open(path);
  const OIIO::ImageSpec spec = input->spec();
  require_whole_picture(spec, path);
  const bool linear = spec.format.is_floating_point();
  if (!linear && spec.format != OIIO::TypeDesc::UINT8 && spec.format != OIIO::TypeDesc::UINT16) {
    cannot("read", path,
           fmt::format("expected 8 or 16 bits a channel, or floats, got {}", spec.format.c_str()));
  }
  PlaneImage image;
  image.width_px = spec.width;
  image.height_px = spec.height;
  image.encoding = linear ? Encoding::Linear : Encoding::Srgb;
  image.bits = linear ? 0 : static_cast<int>(8 * spec.format.size());
  image.metadata = get_metadata(spec);
  for (int c = 0; c < spec.nchannels; ++c) {
    const bool half = spec.channelformat(c) == OIIO::TypeDesc::HALF;
    image.planes.push_back(
        {spec.channel_name(c), std::vector<float>(image.size()), half ? 11 : 24});
  }
  const auto stride = static_cast<std::size_t>(spec.nchannels);
  const auto put = [&](const auto& pixels, double scale) {
    parallel_for(static_cast<std::int64_t>(image.size()), 65536, [&](std::int64_t at) {
      const auto k = static_cast<std::size_t>(at);
      for (std::size_t c = 0; c < stride; ++c)
        image.planes[c].values[k] = static_cast<float>(pixels[k * stride + c] / scale);
    });
  };
  if (linear) {
    put(read_pixels<float>(*input, path, OIIO::TypeDesc::FLOAT), 1.0);
  } else if (image.bits == 8) {
    put(read_pixels<std::uint8_t>(*input, path, OIIO::TypeDesc::UINT8), 255.0);
  } else {
    put(read_pixels<std::uint16_t>(*input, path, OIIO::TypeDesc::UINT16), 65535.0);
  }
  if (input->seek_subimage(1, 0)) cannot("read", path, "it has more than one part");
  return image;
}

}  // namespace plumb::image
