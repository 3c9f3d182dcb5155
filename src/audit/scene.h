// A picture to be drawn, written down: terrain, camera, and who draws it.
#pragma once

#include <string>

#include "audit/camera_file.h"
#include "audit/method.h"
#include "core/camera.h"
#include "core/claim.h"
#include "terrain/heightfield.h"
#include "terrain/read_options.h"

namespace plumb::audit {

/// Who draws a scene.
enum class Painter {
  Method,  // a method's surface, through the rasteriser
  Truth,   // rays against the full-detail surface
};

struct Scene {
  std::string terrain;        // a file, or a generator
  terrain::ReadOptions read;  // how it is read
  std::string diagonal;       // of the full-detail surface; empty: the one that the method has
  CameraDescription camera;   // needs eye and target, or a preset
  Painter painter = Painter::Method;
  std::string method;   // may be empty for the truth
  MethodChoice choice;  // variant and parameters
  Tolerance tolerance;  // of the method
  std::string drape;    // a picture laid over the ground in place of the tint; empty: none
};

/// Reads a scene from TOML:
///
///   [terrain]            source = "generate:alpine?size=129" or a file, which is looked for beside
///                        the scene; and the command line's options with underscores: window,
///                        spacing, band, decode, height_scale, height_offset, nodata, no_data, crs,
///                        raw, byte_order, origin, surface,
///                        diagonal. Lists may stand for commas: [10, 20].
///   [camera]             as in a camera file
///   [method]             name, variant, tolerance = "1px"
///   [method.parameters]  as the method names them
///   [render]             what = "method" (if left out) or "truth"; drape = a picture (PNG, JPEG,
///                        TIFF, EXR), looked for beside the scene, laid over the whole terrain with
///                        its top side in the north
///
/// Throws InputError, one line with the file and the place in it, for anything else: an unknown key
/// is an error that names the known ones. Whether method, variant and parameters exist is seen when
/// the scene is drawn.
Scene read_scene_file(const std::string& path);

/// The same from the text of such a file; `name` stands for it in messages, and files are looked
/// for in `folder` (where the command runs, if that is empty).
Scene parse_scene(const std::string& text, const std::string& name, const std::string& folder = "");

/// The scene as TOML.
///
///   (1) Reading it gives the same scene, to the last bit of every number.
std::string to_toml(const Scene& scene);

/// A camera as one line, "{ eye = [1.0, 2.0, 3.0], target = [4.0, 5.0, 6.0] }".
///
///   (1) parse_inline_camera gives the same camera, to the last bit of every number.
std::string inline_toml(const CameraDescription& camera);

/// Every value of a camera, as a scene writes it down.
CameraDescription description_of(const LookAt& camera);

}  // namespace plumb::audit
