// The truth that a surface which is no heightfield is held against.
#pragma once

#include <optional>

#include "core/drawn_surface.h"
#include "core/triangle_mesh.h"
#include "reference/embree_caster.h"
#include "reference/mesh_nearest.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// The full-detail surface of a terrain of stacks with what is needed to question it, made once.
/// Keeps a reference to the terrain.
class MeshTruth {
 public:
  /// field    what `surface` is the full detail of; places are relative to its origin, and its
  ///          samples are the outline
  /// surface  has a mesh; its patches and levels are left out, its colours kept
  /// Throws std::invalid_argument without a mesh, or unless its corners are vertices and its
  /// vertices finite; InputError if memory does not suffice.
  MeshTruth(const terrain::Heightfield& field, DrawnSurface surface);
  MeshTruth(terrain::Heightfield&&, DrawnSurface) = delete;

  const terrain::Heightfield& field() const { return *field_; }
  const DrawnSurface& surface() const { return surface_; }
  const TriangleMesh& mesh() const { return *surface_.mesh; }
  const reference::EmbreeCaster& caster() const { return caster_; }
  /// Nothing where the mesh has no triangle.
  const std::optional<reference::MeshNearest>& nearest() const { return nearest_; }
  /// How far rounding may put a point of the mesh off it, metres.
  double slack_m() const { return slack_m_; }

 private:
  const terrain::Heightfield* field_;
  DrawnSurface surface_;
  reference::EmbreeCaster caster_;
  std::optional<reference::MeshNearest> nearest_;
  double slack_m_;
};

/// Of a mesh's coordinates: corners, differences of them and weights are rounded at their
/// magnitude, a few times each.
double mesh_slack_m(const TriangleMesh& mesh);

}  // namespace plumb::audit
