// What a method hands over to be drawn and judged.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/claim.h"
#include "core/cost.h"
#include "core/hit_image.h"
#include "core/layers.h"
#include "core/mesh_runs.h"
#include "core/triangle_mesh.h"

namespace plumb {

/// A picture of a surface.
struct SurfacePicture {
  HitImage image;
  std::int64_t fragments = 0;  // that were tested, overdraw included
  Layers layers = {};          // what is blended over the image's hits; colours alone show it
};

/// Draws a surface that is no mesh. `primitive` is the patch that each pixel shows.
///
///   (1) A function of the camera alone: the same bits on any number of threads.
using SurfacePainter = std::function<SurfacePicture(const Camera& camera)>;

/// A run of consecutive triangles that a report can name.
struct Patch {
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
  int lod = 0;       // coarsest level in it, 0 is the finest
  std::string name;  // for people: where it is, in the method's own words
  int kind = 0;      // of DrawnSurface::kinds
};

/// The surface that a method would draw for one camera, and what it promises about it.
///
/// The mesh is shared, so that a method whose surface does not depend on the view hands out the one
/// that it prepared. Patches are ordered by `first_triangle` and cover every triangle; an empty
/// list is one patch. Every drawn surface claims coverage zero; the method need not say so.
///
/// A surface of slices is no mesh: it has a painter in its place, patch k is "triangle" k of one
/// triangle, and what is said of triangles here is said of patches.
struct DrawnSurface {
  std::shared_ptr<const TriangleMesh> mesh;
  SurfacePainter painter;  // where `mesh` is null
  /// Where `mesh` is null: the ground is drawn as a solid, as slices do, so that a ray that gets
  /// below it without crossing it sees it at once. False: a sheet, as the truth is.
  bool is_solid = true;
  /// Of `mesh`, where one mesh serves many cameras; null where each has its own.
  std::shared_ptr<const MeshRuns> runs;
  std::vector<std::uint8_t>
      triangle_lod;  // level of each triangle, 0 the finest; empty if there are no levels
  /// Linear, of each vertex of `mesh`, for pictures alone; empty: coloured by height.
  std::vector<glm::vec3> vertex_colours;
  std::vector<Patch> patches;
  static constexpr std::size_t kMostKinds = 6;
  std::vector<std::string> kinds;  // of patches, for a picture; empty: all are alike
  std::vector<Claim> claims;
  /// Where the tolerance is out of reach: how far up or down the surface may stray there, metres.
  double out_of_reach_m = 0.0;
  Cost cost;
  std::vector<std::string> notes;  // what a user should know: bounds out of reach, choices made

  /// How many primitives a picture of it may name: triangles, or patches.
  std::size_t primitive_count() const {
    return mesh != nullptr ? mesh->triangles.size() : patches.size();
  }
  /// `runs` if they are those of `mesh`, else null: somebody may have put another mesh in its
  /// place.
  const MeshRuns* usable_runs() const {
    return runs != nullptr && runs->mesh() == mesh ? runs.get() : nullptr;
  }
};

/// Index of the patch that holds a triangle; 0 where the surface has no patches.
inline int patch_of(const DrawnSurface& surface, std::uint32_t triangle) {
  int low = 0, high = static_cast<int>(surface.patches.size());
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (surface.patches[static_cast<std::size_t>(middle)].first_triangle <= triangle ? low : high) =
        middle;
  }
  return low;
}

/// The same for a triangle that is likely to lie in patch `guess`.
inline int patch_of(const DrawnSurface& surface, std::uint32_t triangle, int guess) {
  const auto at = static_cast<std::size_t>(guess);
  const bool holds =
      guess >= 0 && at < surface.patches.size() && surface.patches[at].first_triangle <= triangle &&
      (at + 1 == surface.patches.size() || triangle < surface.patches[at + 1].first_triangle);
  return holds ? guess : patch_of(surface, triangle);
}

}  // namespace plumb
