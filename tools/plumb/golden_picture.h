// The picture of a golden case: drawn again, or read from a file; and its reference, written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "audit/scene.h"
#include "golden_manifest.h"
#include "image/aov_image.h"
#include "image/plane_image.h"

namespace plumb::tool {

/// The scene of a scene file, or of the header of a picture (.exr) that plumb made. Throws
/// InputError.
audit::Scene read_scene_or_picture(const std::string& path);

/// The scene in a picture's header; none without one. Throws InputError for one that is none.
std::optional<audit::Scene> scene_of_header(const image::PlaneImage& picture,
                                            const std::string& path);

/// The picture of a scene, with the methods that come with plumb. Throws InputError.
image::AovImage draw(const audit::Scene& scene);

/// Who draws the scene: "rays", "restricted-quadtree, 1px".
std::string painter_text(const audit::Scene& scene);

/// Writes ref/picture.exr and ref/picture.png of a case that plumb draws: both are made before
/// either replaces what is there. Throws InputError.
void write_reference(const GoldenManifest& manifest, const std::string& name,
                     const image::AovImage& picture);

/// Copies a file byte for byte to ref/picture.EXT (the extension in small letters) and takes away
/// references in other formats. Throws InputError, also if the copy is not the picture of that
/// checksum (somebody is writing the file); nothing is replaced then.
void copy_reference(const GoldenManifest& manifest, const std::string& name,
                    const std::filesystem::path& file, std::uint64_t checksum);

/// Whether ref/picture.png is the preview of this picture.
bool is_preview(const std::filesystem::path& png, const image::AovImage& picture);

/// A file's bytes under another name, whole or not at all. Throws InputError.
void copy_whole(const std::filesystem::path& from, const std::filesystem::path& to);
/// Throws InputError if it cannot be made.

/// ".png" of "a/b.PNG".
std::string small_extension(const std::filesystem::path& path);

}  // namespace plumb::tool
