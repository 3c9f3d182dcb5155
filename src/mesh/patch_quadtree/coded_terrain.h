// A whole terrain as coded patches, and patches out of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/grid.h"
#include "mesh/patch_quadtree/container.h"
#include "mesh/patch_quadtree/modelled_patch.h"
#include "mesh/patch_quadtree/patch_numbers.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::patch_quadtree {

struct EncodeOptions {
  double error_m = 1.0;  // > 0: no decoded height of the finest level is farther off
  CodecVersion version = CodecVersion::Modelled;
  int patch_cells = 128;  // a power of two from 8 to 1024
};

/// A terrain's header and heights; the payload's records are empty.
struct EncodedHeights {
  ContainerHeader header;
  std::vector<Bytes> heights;  // as ContainerRecords has them
};

/// Codes every patch, on all threads. The same bytes on any number of them.
///
///   (1) Every height decoded from the finest level is within error_m of the terrain's, single
///       precision included: each was decoded again and compared.
///   (2) Voids are decoded as voids, on every level, and nothing else is.
/// Throws InputError as quantiser_for does, std::invalid_argument for a terrain of fewer than 2 x 2
/// samples or other patch_cells.
EncodedHeights encode_heights(const terrain::Heightfield& field, const EncodeOptions& options);

/// Decodes what a container holds, from any thread. Keeps a reference to it.
class PatchDecoder {
 public:
  explicit PatchDecoder(const Container& container);

  const ContainerHeader& header() const { return container_.header(); }
  /// A patch's numbers, by way of its ancestors.
  PatchNumbers numbers(const PatchPlace& patch) const;
  /// The same of one whose parent is at hand.
  PatchNumbers numbers(const PatchPlace& patch, const PatchNumbers& parent) const;
  /// (n + 3) x (n + 3) heights, NaN for voids.
  Grid<float> heights(const PatchPlace& patch) const;
  /// All samples of a level, on all threads: sample (i, j) of the grid stands at the terrain's
  /// column min(i 2^level, last) and row likewise.
  Grid<float> level_heights(int level) const;

 private:
  PatchNumbers root() const;
  [[noreturn]] void damaged(const PatchPlace& patch) const;

  const Container& container_;
  std::optional<ModelTables> tables_;  // of version 2
};

}  // namespace plumb::mesh::patch_quadtree
