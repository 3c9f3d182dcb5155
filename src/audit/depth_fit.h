// What is wrong with a stranger's frame before any error of it means something.
#pragma once

#include <optional>
#include <string>

#include "audit/depth_meaning.h"
#include "audit/truth.h"
#include "core/camera.h"
#include "core/claim.h"
#include "core/hit_image.h"
#include "image/depth_file.h"

namespace plumb::audit {

/// What explains a frame, or that nothing does.
struct Misfit {
  std::string text;     // one line
  bool refuses = true;  // false: most of the frame keeps to the tolerance all the same
};

/// Compares a depth buffer, as it is said to be read, with the truth; and, unless most of it is
/// right to the buffer's own rounding, with the truth under every other reading that is known to
/// happen: rows or columns the other way round, another convention, both, another unit, other near
/// and far planes, the field of view taken for the other axis, a shift by half a pixel or a whole
/// one, a terrain mirrored, turned or half a sample off, an eye relative to the terrain's origin,
/// an eye or heights off by a constant or a factor.
///
/// A frame's *misfit* is the mean difference of depth, |a - b| / max(a, b), over the pixels of a
/// grid in which either shows terrain; 0 where the truth lies within the number's rounding, 1 where
/// one of the two shows nothing.
///
///   (1) A reading is named if its misfit is at most 1/kFarBetter of the stated one's: it explains
///       nearly all that is wrong, in nearly all places. Rows, columns and conventions, which show
///       the same terrain through the same camera, need 1/kFarBetterNumbers, or that nine tenths
///       of the frame keep to the tolerance, of which as stated less than half did; what is fitted,
///       or slight as a shift by half a pixel is, 1/kFarBetterThanCoarse if the stated misfit is no
///       larger than that of a level of detail of the terrain (coarse_truths through the same
///       camera). Of several the plainest is named, unless another is better by kFarBetter. Unit,
///       planes, heights and eye are fitted, and tried only where most of the frame is beyond the
///       tolerance.
///   (2) What a coarse level of detail does is explained by none of them: its errors change their
///       sign from place to place, so that moving, turning or scaling all of it makes as much
///       worse as it makes better. On three generated terrains, strides 2 to 64 from three views,
///       the best gained a factor of 4.6 by another camera, 8 by fitting heights. Nor are holes and
///       noise explained, of which every reading has its share.
///   (3) If nothing is named and most of the frame is beyond the tolerance, it is refused as one of
///       another camera or terrain if nothing is drawn; if the misfit of what is drawn is larger
///       than that of every level of detail: no frame that shows the terrain at all need be so
///       wrong; or if its misfit is at least kChance of its least misfit with the terrain turned by
///       a quarter or mirrored (turned_cameras that differ from the truth by half the misfit or
///       more): it is no nearer to this ground than to any other. Holes are the audit's matter.
///   (4) A shift by half a pixel or half a sample is a hint, and refuses no frame of which most
///       keeps to the tolerance. A wrong convention is refused however small its errors are: from
///       above, a frame that is upside down may be off by less than a pixel everywhere.
/// Nothing: the frame fits. true_hits is the truth through `camera`; sizes are equal.
std::optional<Misfit> misfit_of_depth(const HeightfieldTruth& truth, const HitImage& true_hits,
                                      const image::DepthBuffer& buffer, const DepthMeaning& meaning,
                                      const Camera& camera, const Tolerance& tolerance);

/// See (3).
inline constexpr double kChance = 0.9;

inline constexpr double kFarBetter = 10.0, kFarBetterNumbers = 4.0, kFarBetterThanCoarse = 40.0;

}  // namespace plumb::audit
