// A patch of a restricted quadtree by the rules as they are printed, to be audited: the library's
// own method departs from them.
#pragma once

#include "core/claim.h"
#include "core/drawn_surface.h"
#include "terrain/heightfield.h"

namespace plumb::audit::stability {

struct PrintedRules {
  int step = 1;  // the patch has every step-th sample: a power of two
  /// Algorithm 2, line 5, word for word: it looks at the vertices that v depends on, in place of
  /// those that depend on v.
  bool word_for_word = false;
};

/// The whole terrain as one patch: from the finest level to the coarsest, a vertex is kept if one
/// that depends on it is, or if a merged triangle is off by the threshold or more at a sample of
/// the patch.
///
/// threshold  metres
/// returns    claims the threshold for every sample
/// Throws InputError unless the terrain has 2^n + 1 samples a side, no void, and the threshold is
/// in metres. Source: [Intel sample 2012, algorithm 2].
DrawnSurface printed_quadtree(const terrain::Heightfield& field, const Tolerance& threshold,
                              const PrintedRules& rules = {});

}  // namespace plumb::audit::stability
