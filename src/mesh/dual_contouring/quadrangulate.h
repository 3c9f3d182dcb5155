// From densities to a mesh of quads.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

#include "core/triangle_mesh.h"
#include "mesh/dual_contouring/allocation.h"
#include "mesh/dual_contouring/faces.h"
#include "mesh/dual_contouring/lattice.h"
#include "mesh/dual_contouring/vertex_place.h"

namespace plumb::mesh::dual_contouring {

struct Options {
  Variant variant = Variant::Conservative;
  Placement placement = Placement::Mean;
};

struct QuadMesh {
  std::vector<glm::dvec3> position;  // in units of the lattice: whole numbers are samples
  std::vector<Quad> quads;
};

/// The surface where the density is 1/2, a vertex for each active cell (or each of its loops) and a
/// face for each crossing edge whose four cells are in the lattice.
///
///   (1) Conservative: every edge of the mesh has two faces, of opposite direction, except at the
///       lattice's border, and the faces round each vertex are one fan.
///   (2) Faces are counter-clockwise seen from outside.
///   (3) The same bits on any number of threads.
/// Throws std::invalid_argument for more than 2^32 - 2 vertices or faces.
/// Source: [Löffler, Müller & Schumann 2011, section 3.2]; [Nielson 2004].
QuadMesh quadrangulate(const Lattice<float>& density, const Options& options = {});

/// The faces of the edges whose lower end is one of a block of voxels (allocation.h): what lies
/// round it in the lattice is looked at.
QuadMesh quadrangulate(const Lattice<float>& density, const Options& options,
                       const LatticeBox& voxels);

/// Two triangles a quad, along its diagonal from corner 0 to 2.
///
/// spacing_m  metres a unit of the lattice
/// returns    vertices are position * spacing_m relative to origin_m, the place of (0, 0, 0)
TriangleMesh to_triangles(const QuadMesh& mesh, const glm::dvec3& origin_m = glm::dvec3(0.0),
                          const glm::dvec3& spacing_m = glm::dvec3(1.0));

}  // namespace plumb::mesh::dual_contouring
