// What a node's surface is made of.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

#include "mesh/stacks/node_mesh.h"
#include "mesh/stacks/stack_densities.h"

namespace plumb::mesh::stacks {

/// The linear colour of each vertex: of the field's materials but air, by their smoothed densities,
/// trilinear at the vertex on its own level.
///
///   (1) A function of the vertex's name and place alone: nodes that share one colour it alike.
/// Source: [Löffler, Müller & Schumann 2011, section 3.2.4].
std::vector<glm::vec3> node_colours(const NodeMesh& mesh, const StackDensities& densities);

}  // namespace plumb::mesh::stacks
