// How the triangles of a mesh hang together, by the rules of the surface that it should be.
#pragma once

#include <glm/vec3.hpp>

#include "audit/mesh_edges.h"
#include "audit/topology.h"
#include "core/drawn_surface.h"

namespace plumb::audit {

/// What is a flaw and what is as it should be. Points are relative to origin_m().
class SheetRules {
 public:
  virtual ~SheetRules() = default;
  virtual glm::dvec3 origin_m() const = 0;  // world
  /// Nearer than this is at the same place, metres.
  virtual double beside_m() const = 0;
  /// Where two points are at one place, as far as T-junctions are concerned.
  virtual glm::dvec3 place(const glm::dvec3& point_m) const = 0;
  /// An edge of one triangle, where the surface should go on.
  virtual bool is_open(const glm::dvec3& a, const glm::dvec3& b) const = 0;
  /// A triangle with an area, by its normal of any length and its corners.
  virtual bool is_folded(const glm::dvec3& normal, const glm::dvec3& a, const glm::dvec3& b,
                         const glm::dvec3& c) const = 0;
  /// False: no triangle is folded by what its neighbours are like, and nobody need ask.
  virtual bool folds_at_edges() const = 0;
  /// Two triangles that share an edge and run the same way round, by their normals of any length.
  virtual bool is_folded_at_edge(const glm::dvec3& a, const glm::dvec3& b) const = 0;
  /// The true surface itself hangs together by that point alone.
  virtual bool may_pinch(const glm::dvec3& point_m) const = 0;
};

/// Everything but `overlapped_samples` and `self_intersections`.
Topology examined(const SheetRules& rules, const DrawnSurface& surface, const MeshEdges& edges,
                  int most_listed);

}  // namespace plumb::audit
