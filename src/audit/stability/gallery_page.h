// The failure gallery for people: pictures, a page, and the same as Markdown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "audit/stability/run_scene.h"
#include "image/colour_image.h"

namespace plumb::audit::stability {

/// Published, conservative, and where the error of the first lies, side by side with a line below
/// each. Empty if neither was drawn.
image::Rgb8Image scene_picture(const SceneRun& run);

/// Of the scene's picture, beside the page: "figures/failures/NAME.png"; empty where there is none.
std::string figure_name(const SceneRun& run);

/// docs/failures.md, as it stands in the repository if `runs` are those of all scenes.
///
///   (1) The same bytes on every machine and number of threads.
std::string gallery_markdown(const std::vector<SceneRun>& runs);

/// Writes failures.md, failures.html and the figures into `folder`, which is made if it is not
/// there. Returns the names of the files. Throws InputError if one cannot be written.
std::vector<std::string> write_gallery_page(const std::filesystem::path& folder,
                                            const std::vector<SceneRun>& runs);

}  // namespace plumb::audit::stability
