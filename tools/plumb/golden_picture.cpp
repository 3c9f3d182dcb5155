#include "golden_picture.h"

#include <cctype>

#include "audit/picture.h"
#include "audit/scene_picture.h"
#include "audit/toml_document.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "image/image_files.h"
#include "image/srgb.h"
#include "version.h"

namespace plumb::tool {
namespace fs = std::filesystem;

audit::Scene read_scene_or_picture(const std::string& path) {
  if (!path.ends_with(".exr")) return audit::read_scene_file(path);
  std::optional<audit::Scene> scene = scene_of_header(image::read_planes(path), path);
  if (!scene) input_error("{}: its header holds no scene: it was not drawn by one", path);
  return *std::move(scene);
}

std::optional<audit::Scene> scene_of_header(const image::PlaneImage& picture,
                                            const std::string& path) {
  const auto found = picture.metadata.find("scene");
  const std::string* text =
      found == picture.metadata.end() ? nullptr : std::get_if<std::string>(&found->second);
  if (text == nullptr) return std::nullopt;
  return audit::parse_scene(*text, path + " (header)");
}

image::AovImage draw(const audit::Scene& scene) {
  return audit::draw_scene(scene, audit::built_in_methods(), version_number()).picture;
}

std::string painter_text(const audit::Scene& scene) {
  return scene.painter == audit::Painter::Truth ? "rays"
                                                : scene.method + ", " + to_text(scene.tolerance);
}

void copy_whole(const fs::path& from, const fs::path& to) {
  write_file_atomically(to, audit::read_text_file(from.string(), "picture"));
}

std::string small_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& letter : extension)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return extension;
}

void write_reference(const GoldenManifest& manifest, const std::string& name,
                     const image::AovImage& picture) {
  const std::string exr = image::exr_bytes(picture);
  const std::string png = image::png_bytes(image::to_srgb8(audit::preview_of(picture)));
  make_folder(manifest.exr(name).parent_path());
  write_file_atomically(manifest.exr(name), exr);
  write_file_atomically(manifest.png(name), png);
}

void copy_reference(const GoldenManifest& manifest, const std::string& name, const fs::path& file,
                    std::uint64_t checksum) {
  const fs::path ref = manifest.exr(name).parent_path();
  const fs::path target = ref / ("picture" + small_extension(file));
  const std::vector<fs::path> before = manifest.references(name);
  make_folder(ref);
  TemporarySibling copy(target);
  std::error_code error;
  fs::copy_file(file, copy.path(), fs::copy_options::overwrite_existing, error);
  if (error)
    input_error("cannot copy '{}' to '{}': {}", file.string(), target.string(), error.message());
  if (image::raw_checksum(image::read_planes(copy.path())) != checksum)
    input_error("{}: it changed while it was being looked at; nothing is replaced", file.string());
  copy.commit();
  for (const fs::path& old : before) {
    if (old != target) fs::remove(old);
  }
}

bool is_preview(const fs::path& png, const image::AovImage& picture) {
  return fs::exists(png) && image::read_png(png) == image::to_srgb8(audit::preview_of(picture));
}

}  // namespace plumb::tool
