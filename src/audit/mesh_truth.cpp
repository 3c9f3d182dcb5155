#include "audit/mesh_truth.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "audit/drawn_point.h"
#include "core/check.h"

namespace plumb::audit {
namespace {

DrawnSurface as_truth(DrawnSurface surface) {
  require(surface.mesh != nullptr, "the truth of a terrain of stacks must be a mesh");
  surface.patches.clear();
  surface.triangle_lod.clear();
  surface.kinds.clear();
  surface.claims.clear();
  return surface;
}

}  // namespace

double mesh_slack_m(const TriangleMesh& mesh) {
  const Box box = bounds(mesh);
  if (box.empty()) return 0.0;
  const double reach = std::max(largest_coordinate(box.low), largest_coordinate(box.high));
  return 64.0 * std::numeric_limits<double>::epsilon() * reach;
}

MeshTruth::MeshTruth(const terrain::Heightfield& field, DrawnSurface surface)
    : field_(&field),
      surface_(as_truth(std::move(surface))),
      caster_(*surface_.mesh),
      slack_m_(mesh_slack_m(*surface_.mesh)) {
  if (!surface_.mesh->triangles.empty()) nearest_.emplace(*surface_.mesh);
}

}  // namespace plumb::audit
