// How far a drawn mesh lies above or below the truth, at samples and at given places.
#pragma once

#include <glm/vec2.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "audit/flat_triangle.h"
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
  /// One more triangle that covers the place, `delta` above the truth.
  void add(double delta, std::uint32_t index, Cover cover) {
    sheets += cover == Cover::Inside;
    if (covered() && !(std::abs(delta) > std::abs(delta_m))) return;
    delta_m = delta;
    triangle = index;
  }
};

/// Cells by which a search for triangles over a place reaches beyond their boxes.
inline constexpr double kNearLine = 1e-6;

/// What lies over one row of samples, a column each; the arrays are a CoverRow's, padded as those.
struct DeviationRow {
  const float* heights_m;  // of the truth
  const double* delta_m;   // drawn minus truth
  const double* triangle;  // its number; negative where nothing is drawn
  const double* sheets;    // triangles that hold the sample in their inside

  Deviation operator[](int i) const {
    return {delta_m[i], triangle[i] < 0.0 ? kNoPrimitive : static_cast<std::uint32_t>(triangle[i]),
            static_cast<std::uint32_t>(sheets[i])};
  }
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
                         const std::function<void(int, const DeviationRow&)>& visit);

/// The same at any places of the terrain's plane (x, y, height of the truth there), relative to the
/// terrain's origin. At most 2^32 - 1 places.
std::vector<Deviation> deviation_at(const terrain::Heightfield& field, const TriangleMesh& mesh,
                                    const std::vector<glm::dvec3>& places_m);

}  // namespace plumb::audit
