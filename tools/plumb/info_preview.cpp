#include "info_preview.h"

#include "core/check.h"
#include "image/image_files.h"
#include "raster/shading/preview.h"

namespace plumb::tool {

namespace {
constexpr int kLongestSide_px = 2048;
}

void write_preview(const std::string& path, const terrain::Heightfield& field) {
  if (!path.ends_with(".png")) input_error("preview '{}': expected a name that ends in .png", path);
  image::write_png(path, raster::shaded_preview(field, kLongestSide_px));
}

}  // namespace plumb::tool
