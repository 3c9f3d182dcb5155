// A picture with every channel and a header from which it can be made again.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/camera.h"
#include "core/claim.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"
#include "core/layers.h"
#include "image/aov_image.h"
#include "image/colour_image.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// Who drew a picture, for its header.
struct PictureMaker {
  std::string method;   // "truth" where rays met the full-detail surface
  std::string variant;  // empty where there is none
  std::map<std::string, std::string> parameters;
  std::optional<Tolerance> tolerance;                           // nothing for the truth
  terrain::Diagonal diagonal = terrain::Diagonal::Alternating;  // of the full-detail surface
  std::string program_version;
  std::string scene_toml;  // the scene that draws it again (scene.h); empty where there is none
  /// Laid over the whole terrain in place of the tint, its top side in the north; null: none.
  const image::ColourImage* drape = nullptr;
  /// Blended over the hits in R G B alone; null: nothing is.
  const Layers* layers = nullptr;
};

/// The picture of a surface that was drawn: R G B, Z, P, N, id, lod and, where fragments were
/// counted, overdraw.
///
/// drawn   what `camera` sees; `primitive` indexes the surface's triangles
/// returns id is the patch, lod the level of the triangle (of its patch, where triangles have
///         none), N flat; coloured by height between the terrain's lowest and highest sample.
///         Metadata: method, variant, parameter.NAME, tolerance, diagonal, terrain.source,
///         terrain.checksum, terrain.window ("x,y,width,height"), program, scene, and camera.* as
///         doubles.
///
///   (1) Same bits on any number of threads; no clock, machine or thread count is in it.
/// Throws std::invalid_argument if shapes differ or a hit names a triangle that is not there.
image::AovImage draw_picture(const terrain::Heightfield& field, const HitImage& drawn,
                             const DrawnSurface& surface, const Camera& camera,
                             const PictureMaker& maker);

/// The same of rays that met the full-detail surface: `primitive` is terrain::triangle_index for
/// maker.diagonal, id and lod are 0.
image::AovImage draw_truth_picture(const terrain::Heightfield& field, const HitImage& true_hits,
                                   const Camera& camera, const PictureMaker& maker);

/// Its colours alone, for a preview. Throws std::invalid_argument if it has none.
image::ColourImage preview_of(const image::AovImage& picture);

}  // namespace plumb::audit
