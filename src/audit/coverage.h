// Holes, overshoots and see-through cracks: what no mean can see.
#pragma once

#include <cstdint>
#include <vector>

#include "audit/band_walk.h"
#include "audit/truth.h"
#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// What the truth demands of a pixel.
enum class Demand : std::uint8_t {
  Terrain,  // terrain here and all around
  Sky,      // nothing here nor all around
  Either,   // near a silhouette: both are legal
};

enum class DefectKind : std::uint8_t {
  None,
  Hole,        // nothing drawn where there must be terrain
  Overshoot,   // terrain drawn where there must be nothing
  SeeThrough,  // drawn terrain that the truth hides: something in front of it is missing
};

const char* name_of(DefectKind kind);  // "hole", "overshoot", "see-through"

struct CoverageDefect {
  DefectKind kind = DefectKind::None;
  int x = 0, y = 0;
  double true_depth_m = kNoHit, drawn_depth_m = kNoHit;
  int patch_a = -1,
      patch_b = -1;  // the patches that meet there, as drawn around the pixel; -1 for none
};

struct Coverage {
  int band_px = 1;
  std::int64_t must_be_terrain = 0, must_be_sky = 0, either = 0;  // pixels
  std::int64_t holes = 0, overshoots = 0, see_through = 0;
  std::vector<Demand> demand;       // a pixel each
  std::vector<DefectKind> defects;  // a pixel each
  std::vector<CoverageDefect>
      listed;  // the first of each kind, row by row, at most `most_listed` of a kind

  std::int64_t defect_count() const { return holes + overshoots + see_through; }
};

/// Compares what is drawn with what the truth demands.
///
///   (1) A pixel is undecided where the truth changes between terrain and sky within `tolerance_px`
///   (at least one pixel). (2) A defect that rests on the truth at pixel centres alone is looked at
///   again with truth rays between the centres, so
///       that terrain or sky narrower than a pixel is not held against the picture; and, where the
///       surface may stray by metres, as far around as `band.metres` reach on screen at that
///       point's depth.
///   No hole is where the pixel's ray, all the way from the near plane, runs no farther above the
///   truth than the band, or on to the far plane no farther below it: the surface may lie above the
///   eye, or beyond the picture.
///   An overshoot is none if there is truth above or below the point drawn within the band: seen
///   edge on, it is hit by no ray.
///   (3) See-through: the point drawn lies behind all truth within the band, the truth above or
///   below that point is itself hidden, and on its way there the pixel's ray runs deeper below the
///   truth than the band. A surface that is merely displaced is the pixel error's matter.
/// surface    names patches; its mesh's triangles are `drawn.primitive`
/// set_aside  1 for pixels that are not judged (set_aside.h); empty if there are none
Coverage coverage_of(const HeightfieldTruth& truth, const HitImage& true_hits,
                     const HitImage& drawn, const Camera& camera, const DrawnSurface& surface,
                     const Band& band, const std::vector<std::uint8_t>& set_aside = {},
                     int most_listed = 100);

}  // namespace plumb::audit
