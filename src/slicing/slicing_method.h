// Adaptive slicing and the hybrid of slices and polygons, as methods that can be drawn and audited.
#pragma once

#include <memory>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "slicing/blended_rays.h"
#include "slicing/height_lookup.h"
#include "slicing/hybrid_frame.h"
#include "slicing/slicing_cut.h"
#include "slicing/slicing_tree.h"
#include "terrain/heightfield.h"

namespace plumb::slicing {

/// How the cut is found: as the article does, or the one of least cost.
enum class CutChoice { Greedy, Optimum };

struct Parameters {
  int leaf_cells = 8;
  CutChoice choice = CutChoice::Greedy;
  CutOptions cut;  // its tolerance is the one that is drawn with
  Interpolation heights = Interpolation::Triangulated;
  SliceRenderer renderer = SliceRenderer::Rays;
  BlendOptions blend;  // its fog_base_m is the terrain's lowest sample
};

/// What does not depend on the view. Keeps a reference to the terrain.
struct Prepared {
  Parameters parameters;
  std::shared_ptr<const SlicingTree> tree;
  std::shared_ptr<const HeightLookup> heights;
};

/// Throws std::invalid_argument if a parameter is out of its range.
Prepared prepare(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                 const Parameters& parameters = {});

/// A surface without a mesh: its painter draws the cut that is best for `camera`. A patch is a node
/// of the tree, drawn as slices or as polygons; lod 0 is a leaf.
///
/// tolerance  in pixels, > 0: the gap between slices (published), or the error (conservative)
///   (1) Claims a pixel error of the tolerance. Published: as the article has it, which the audit
///   finds broken. Conservative: as derived in docs/algorithms/slicing.md, for heights that are
///   looked up triangulated; with others nothing is claimed.
/// Throws InputError for a tolerance that is not in pixels, or zero.
/// Source: [Röttger & Ertl 2001].
DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance);

}  // namespace plumb::slicing
