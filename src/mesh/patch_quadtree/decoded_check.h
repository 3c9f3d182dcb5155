// What a container gives back, beside the terrain that went in.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/patch_quadtree/container.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::patch_quadtree {

struct DecodedLevel {
  std::int64_t patches = 0;
  std::int64_t samples = 0;       // compared: those of all patches with their margins
  double promised_m = 0.0;        // no height may be farther off
  double largest_error_m = 0.0;   // between a height decoded and the terrain's, in double
  std::int64_t voids = 0;         // in both
  std::int64_t voids_differ = 0;  // in one of them; promised is none

  bool holds() const { return voids_differ == 0 && largest_error_m <= promised_m; }
};

/// Decodes every patch of every level, on all threads, and compares each sample with the terrain's
/// at the patch's place. One entry a level, the finest first; the same on any number of threads.
///
/// Promised is the error that the header states; with a step that doubles, twice as much on each
/// coarser level.
/// Throws InputError as Container and PatchDecoder do, std::invalid_argument if the terrain has
/// another size.
std::vector<DecodedLevel> check_decoded(const Container& container,
                                        const terrain::Heightfield& field);

/// Throws std::logic_error, naming the level, if one does not hold what is promised.
void require_holds(const std::vector<DecodedLevel>& levels);

}  // namespace plumb::mesh::patch_quadtree
