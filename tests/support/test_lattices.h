// Densities for tests of dual contouring.
#pragma once

#include <cstdint>
#include <functional>
#include <random>

#include "mesh/dual_contouring/lattice.h"

namespace plumb::testing {

using mesh::dual_contouring::Lattice;
using mesh::dual_contouring::LatticeBox;

/// Densities in [0, 1) that have nothing to do with one another.
inline Lattice<float> random_lattice(const LatticeBox& box, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Lattice<float> lattice(box);
  for (float& value : lattice.values())
    value = static_cast<float>(static_cast<double>(random() >> 40) * 0x1p-24);
  return lattice;
}

/// A function of the place of each sample.
inline Lattice<float> sampled_lattice(const LatticeBox& box,
                                      const std::function<double(const glm::dvec3&)>& density) {
  Lattice<float> lattice(box);
  for (std::size_t k = 0; k < lattice.values().size(); ++k)
    lattice.values()[k] = static_cast<float>(density(glm::dvec3(box.at(k))));
  return lattice;
}

}  // namespace plumb::testing
