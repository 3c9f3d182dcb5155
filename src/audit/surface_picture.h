// A drawn surface as a picture: through the rasteriser, or by its own painter.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// What `camera` sees of the surface. Throws std::invalid_argument unless it has a mesh or a
/// painter.
SurfacePicture picture_of(const DrawnSurface& surface, const Camera& camera);

/// Normals to shade a picture of the surface by, a pixel each; zero where nothing is seen. Those of
/// the triangles drawn; of a surface without a mesh those of the terrain above or below each point,
/// as slices are textured with the terrain's own colours.
std::vector<glm::dvec3> shading_normals(const DrawnSurface& surface, const HitImage& drawn,
                                        const Camera& camera, const terrain::Heightfield& field,
                                        terrain::Diagonal diagonal);

/// The colours of the mesh's vertices at what each pixel sees, linear; empty where it has none.
std::vector<glm::vec3> vertex_albedo(const DrawnSurface& surface, const HitImage& drawn,
                                     const Camera& camera);

/// Normals for what is blended over such a picture: one a layer.
std::vector<glm::dvec3> layer_normals(const Layers& layers, const Camera& camera,
                                      const terrain::Heightfield& field,
                                      terrain::Diagonal diagonal);

}  // namespace plumb::audit
