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
/// A frame's *misfit* is the middle difference of depth, |a - b| / max(a, b), over the pixels of a
/// grid in which either shows terrain; 0 where the truth lies within the number's rounding, 1 where
/// one of the two shows nothing.
///
///   (1) A reading is named if its misfit is at most 1/kFarBetter of the stated one's; one that has
///       been fitted to the frame, at most 1/kFarBetterFitted. Of several the plainest is named,
///       unless another is better by kFarBetter.
///   (2) What a coarse level of detail does is explained by none of them: its errors change their
///       sign from place to place, so that moving, turning or scaling all of it makes as much worse
///       as it makes better; and a constant or a factor, which is fitted, leaves more than a tenth.
///   (3) If nothing is named, most of the frame is beyond the tolerance, and may_be_of_terrain
///   denies
///       its points, it is refused as a frame of another camera or terrain.
///   (4) A frame of which most keeps to the tolerance is never refused; what was named is a hint.
/// Nothing: the frame fits. true_hits is the truth through `camera`; sizes are equal.
std::optional<Misfit> misfit_of_depth(const HeightfieldTruth& truth, const HitImage& true_hits,
                                      const image::DepthBuffer& buffer, const DepthMeaning& meaning,
                                      const Camera& camera, const Tolerance& tolerance);

inline constexpr double kFarBetter = 4.0;
inline constexpr double kFarBetterFitted = 10.0;

}  // namespace plumb::audit
