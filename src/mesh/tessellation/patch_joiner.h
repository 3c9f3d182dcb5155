// One mesh of the patches that a frame draws, and what closes their rims.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "core/drawn_surface.h"
#include "core/grid.h"
#include "mesh/tessellation/block_levels.h"
#include "mesh/tessellation/patch_mesh.h"
#include "mesh/tessellation/patch_selection.h"
#include "mesh/tessellation/seams.h"
#include "mesh/tessellation/skirts.h"
#include "mesh/tessellation/tessellation.h"

namespace plumb::mesh::tessellation {

/// What closes a patch's rims: walls of the conservative variant, or the paper's skirts.
struct Rims {
  std::vector<SeamTriangle> seams;
  std::vector<Skirt> skirts;
};

/// Puts patches together: vertices at one place are one vertex, where patches drew them alike.
///
///   (1) A patch is a run of triangles with its claim, and its rims another one behind it; a run
///   without a triangle is none. (2) The same additions in the same order give the same bits.
/// What it is given must outlive it.
class PatchJoiner {
 public:
  /// heights_m  of the drawn patches, (n + 3)^2 each, as decode_drawn has them
  PatchJoiner(const Prepared& prepared, const PatchSelection& selection,
              const std::vector<Grid<float>>& heights_m, const ChosenLevels& levels);

  /// at  place in the selection's drawn patches
  void add(std::size_t at, const PatchMesh& drawn, const Rims& rims);
  /// The mesh, its patches, their claims and their cost; nothing is left here.
  DrawnSurface take();
  /// How many triangles of rims were added.
  std::int64_t rim_triangles() const { return rim_triangles_; }

 private:
  struct RimVertex {
    float height_m;
    std::uint32_t number;
  };

  glm::dvec3 position(std::size_t at, const PatchPoint& point) const;
  std::uint32_t new_vertex(const glm::dvec3& place);
  std::uint32_t rim_vertex(std::size_t at, const PatchPoint& point);
  void wall(int level, const SeamTriangle& seam);
  void hang(std::size_t at, const Skirt& skirt);
  void begin_patch(const patch_quadtree::PatchPlace& place, const char* what, int kind);
  bool end_patch();
  void claim_patch(std::size_t at);

  const Prepared& prepared_;
  const PatchSelection& selection_;
  const std::vector<Grid<float>>& heights_m_;
  const ChosenLevels& levels_;
  std::shared_ptr<TriangleMesh> mesh_ = std::make_shared<TriangleMesh>();
  DrawnSurface surface_;
  std::unordered_map<std::int64_t, std::vector<RimVertex>> rim_;  // looked up, never walked
  std::int64_t rim_triangles_ = 0;
};

}  // namespace plumb::mesh::tessellation
