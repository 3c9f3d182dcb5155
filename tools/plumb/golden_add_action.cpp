// plumb golden add: the one way in which a case comes to be.
#include <fmt/format.h>

#include <iostream>
#include <optional>

#include "compare/folder_pairs.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "golden_actions.h"
#include "golden_manifest.h"
#include "golden_picture.h"
#include "terrain/generators.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;

// A new case on its way into the manifest.
struct NewCase {
  GoldenManifest manifest;
  GoldenCase golden;
  /// The manifest with it. Throws InputError if it may not come in.
  std::string text() const {
    std::string longer = with_case(manifest, golden);
    profile_of(manifest, golden);
    const fs::path place = manifest.folder / golden.name;
    if (fs::exists(place))
      input_error("{}: is there already, though no case names it", place.string());
    return longer;
  }
};

std::string why_text(const std::string& why, const std::string& origin) {
  return fmt::format(
      "{}\n{}.\nA change here is a bug until someone can say why every pixel of it is right.\n",
      why, origin);
}

// A terrain file's name as the scene in `folder` must say it.
std::string seen_from(const fs::path& folder, const std::string& terrain) {
  if (terrain::is_generator(terrain) || !fs::is_regular_file(terrain)) return terrain;
  return fs::proximate(terrain, folder).string();
}

void add_scene(NewCase& added, audit::Scene scene, const image::PlaneImage* source,
               const std::string& subject) {
  const image::AovImage picture = draw(scene);
  added.golden.checksum = image::raw_checksum(picture);
  if (source != nullptr && image::raw_checksum(*source) != added.golden.checksum)
    input_error(
        "{}: the scene in its header draws another picture: give the scene (.toml), or "
        "--as-picture to keep this file",
        subject);
  const std::string text = added.text();
  const std::string& name = added.golden.name;
  const std::string origin = scene.painter == audit::Painter::Truth
                                 ? "rays through the full-detail surface"
                                 : painter_text(scene);
  const std::string why =
      why_text(added.golden.why, fmt::format("Drawn by {}; terrain {}", origin, scene.terrain));
  write_reference(added.manifest, name, picture);
  scene.terrain = seen_from(added.manifest.folder / name, scene.terrain);
  write_file_atomically(added.manifest.scene(name), audit::to_toml(scene));
  write_file_atomically(added.manifest.why(name), why);
  write_file_atomically(added.manifest.path(), text);
}

void add_picture(NewCase& added, const image::PlaneImage& picture, const std::string& file) {
  added.golden.checksum = image::raw_checksum(picture);
  const std::string text = added.text();
  const std::string& name = added.golden.name;
  copy_reference(added.manifest, name, file, added.golden.checksum);
  const std::string kind = picture.bits == 0 ? "floats" : fmt::format("{} bits", picture.bits);
  write_file_atomically(
      added.manifest.why(name),
      why_text(added.golden.why,
               fmt::format("Drawn by another program: {}, {} x {} pixels, {}, {}",
                           fs::path(file).filename().string(), picture.width_px, picture.height_px,
                           image::name_of(picture.encoding), kind)));
  write_file_atomically(added.manifest.path(), text);
}

}  // namespace

int golden_add(const GoldenOptions& options) {
  if (options.name.empty() || options.subject.empty())
    input_error(
        "golden add needs a NAME and a SCENE (a .toml, or an .exr drawn by plumb) or a "
        "PICTURE of another program");
  if (options.why.empty()) input_error("golden add needs --why, one sentence");
  const fs::path folder(options.folder);
  NewCase added{
      fs::exists(folder / "manifest.toml") ? read_manifest(folder) : parse_manifest("", folder),
      {options.name, 0, 0, options.why, options.tolerance.empty() ? "none" : options.tolerance}};
  added.text();  // what may not come in need not be drawn
  if (!compare::is_picture(options.subject)) {
    if (options.as_picture) input_error("{}: it is no picture", options.subject);
    add_scene(added, audit::read_scene_file(options.subject), nullptr, options.subject);
  } else {
    const image::PlaneImage picture = image::read_planes(options.subject);
    std::optional<audit::Scene> scene;
    if (!options.as_picture) scene = scene_of_header(picture, options.subject);
    if (scene) {
      add_scene(added, *std::move(scene), &picture, options.subject);
    } else {
      add_picture(added, picture, options.subject);
    }
  }
  std::cout << fmt::format("{}: added, checksum {}\n", options.name,
                           checksum_digits(added.golden.checksum));
  return 0;
}

}  // namespace plumb::tool
