// The low-pass filter that takes the steps out of the density.
#pragma once

#include "mesh/dual_contouring/lattice.h"

namespace plumb::mesh::dual_contouring {

enum class Kernel {
  Box,    // 2 radius + 1 equal weights
  Gauss,  // binomial weights C(2 radius, k) / 4^radius: standard deviation sqrt(radius / 2) voxels
};

struct Filter {
  Kernel kernel = Kernel::Gauss;
  int radius = 1;  // voxels, 0 to 4; 0: nothing is smoothed

  friend bool operator==(const Filter&, const Filter&) = default;
};

/// Throws std::invalid_argument for a radius outside [0, 4].
void require_valid(const Filter& filter);

/// Each sample's weighted mean with its neighbours: along x, then y, then z.
///
/// returns  the lattice's box without `radius` samples on every side
///
///   (1) Constant densities of 0, 1/2 and 1 stay what they are to the bit.
///   (2) A sample is a function of its neighbourhood alone: the same bits in any box.
///   (3) Mirroring the densities along an axis mirrors the result to the bit.
/// Throws std::invalid_argument for a radius outside [0, 4] and a lattice narrower than 2 radius.
/// Source: [Löffler, Müller & Schumann 2011, section 3.2.2], which leaves kernel and size open.
Lattice<float> smoothed(const Lattice<float>& density, const Filter& filter);

}  // namespace plumb::mesh::dual_contouring
