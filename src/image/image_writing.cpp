// Images to files.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

#include "core/atomic_file.h"
#include "core/check.h"
#include "image/file_words.h"
#include "image/image_files.h"
#include "image/srgb.h"

namespace plumb::image {
namespace fs = std::filesystem;
namespace {

constexpr const char* kNoTime = "1970:01:01 00:00:00";  // OpenImageIO writes the clock otherwise

// Encodes in memory, so that the bytes are ours to write: OpenImageIO's PNG writer does not notice
// a full disk.
std::string encoded(const fs::path& path, const char* format, const OIIO::ImageSpec& spec,
                    const void* pixels) {
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) cannot("write", path, OIIO::geterror());
  OIIO::Filesystem::IOVecOutput memory;
  if (!output->set_ioproxy(&memory)) cannot("write", path, "its encoder needs a file");
  const bool done = output->open(path.string(), spec) && output->write_image(spec.format, pixels) &&
                    output->close();
  if (!done) cannot("write", path, output->geterror());
  const std::vector<unsigned char>& bytes = memory.buffer();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void set_metadata(const std::map<std::string, MetadataValue>& metadata, OIIO::ImageSpec& spec) {
  for (const auto& [name, value] : metadata) {
    require(!name.empty(), "a metadata entry must have a name");
    const std::string full = kMetadataPrefix + name;
    if (const auto* text = std::get_if<std::string>(&value)) spec.attribute(full, *text);
    if (const auto* whole = std::get_if<std::int32_t>(&value)) spec.attribute(full, *whole);
    if (const auto* number = std::get_if<double>(&value)) {
      spec.attribute(full, OIIO::TypeDesc::DOUBLE, number);
    }
  }
}

// Pixel after pixel, the channels that are there side by side.
std::vector<float> interleaved(const AovImage& image, const std::vector<Channel>& present) {
  std::vector<float> pixels(image.size() * present.size());
  for (std::size_t c = 0; c < present.size(); ++c) {
    const std::vector<float>& values = image.*present[c].values;
    for (std::size_t k = 0; k < image.size(); ++k) pixels[k * present.size() + c] = values[k];
  }
  return pixels;
}

}  // namespace

std::string exr_bytes(const AovImage& image) {
  require_valid(image);
  std::vector<Channel> present;
  for (const Channel& channel : channels()) {
    if (!(image.*channel.values).empty()) present.push_back(channel);
  }
  require(!present.empty(), "an image without any channel cannot be written");
  OIIO::ImageSpec spec(image.width_px, image.height_px, static_cast<int>(present.size()),
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const Channel& channel : present) spec.channelnames.push_back(channel.name);
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", kNoTime);
  set_metadata(image.metadata, spec);
  return encoded("picture.exr", "exr", spec, interleaved(image, present).data());
}

void write_exr(const fs::path& path, const AovImage& image) {
  write_file_atomically(path, exr_bytes(image));
}

std::string png_bytes(const Rgb8Image& image) {
  require(image.width_px >= 1 && image.height_px >= 1,
          "an image must be at least 1 x 1 pixels, got {} x {}", image.width_px, image.height_px);
  const std::size_t bytes = static_cast<std::size_t>(image.width_px) * image.height_px * 3;
  require(image.rgb.size() == bytes, "{} x {} pixels need {} bytes, got {}", image.width_px,
          image.height_px, bytes, image.rgb.size());
  OIIO::ImageSpec spec(image.width_px, image.height_px, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  return encoded("picture.png", "png", spec, image.rgb.data());
}

void write_png(const fs::path& path, const Rgb8Image& image) {
  write_file_atomically(path, png_bytes(image));
}

void write_png(const fs::path& path, const ColourImage& image) { write_png(path, to_srgb8(image)); }

}  // namespace plumb::image
