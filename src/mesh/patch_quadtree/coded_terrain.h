// A whole terrain as coded patches; patch_decoder.h has them out again.
#pragma once

#include <vector>

#include "mesh/patch_quadtree/container.h"
#include "mesh/patch_quadtree/patch_decoder.h"
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

}  // namespace plumb::mesh::patch_quadtree
