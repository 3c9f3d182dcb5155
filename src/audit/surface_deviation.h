// How far a drawn mesh lies above or below the truth, at samples and at given places.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// The drawn surface over one place: of all triangles that cover it, the one that is farthest from
/// the truth.
struct Deviation {
  double delta_m = 0.0;                   // drawn minus truth
  std::uint32_t triangle = kNoPrimitive;  // kNoPrimitive: nothing is drawn there
  std::uint32_t sheets =
      0;  // triangles that hold the place in their inside; above 1 the mesh overlaps itself

  bool covered() const { return triangle != kNoPrimitive; }
};

/// One row of samples at a time, in no particular order and from several threads: visit(j,
/// deviations of row j). Void samples get an entry with a delta of NaN where something is drawn
/// over them.
///
/// mesh  any triangles; vertical ones and those without area cover no place
/// triangle_max_m  if given, filled with each triangle's largest distance from a sample that it
/// covers, edges included
void for_each_sample_row(const terrain::Heightfield& field, const TriangleMesh& mesh,
                         std::vector<float>* triangle_max_m,
                         const std::function<void(int, std::span<const Deviation>)>& visit);

/// The same at any places of the terrain's plane (x, y, height of the truth there), relative to the
/// terrain's origin.
std::vector<Deviation> deviation_at(const terrain::Heightfield& field, const TriangleMesh& mesh,
                                    const std::vector<glm::dvec3>& places_m);

}  // namespace plumb::audit
