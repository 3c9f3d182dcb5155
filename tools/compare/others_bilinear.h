// The "bilinear" comparison of the OpenGL and Vulkan conformance suites.
#pragma once

#include <cstdint>

#include "image/colour_image.h"

namespace plumb::compare {

/// Pixels whose colour the other picture has nowhere near, in either direction.
///
/// A pixel has a like one if all its channels are within `tolerance` of one of the 3 x 3 pixels
/// around it, or of one of 28 fixed places between them; it counts if neither the candidate's
/// pixel has a like one in the reference nor the reference's in the candidate.
///
///   (1) Reference and candidate may be exchanged.
/// tolerance in [0, 255], of a channel. Throws std::invalid_argument if it is not, and as
/// require_judgeable does.
/// Source: [VK-GL-CTS, framework/common/tcuBilinearImageCompare.cpp].
std::int64_t bilinear_mismatches(const image::Rgb8Image& reference,
                                 const image::Rgb8Image& candidate, int tolerance = 7);

}  // namespace plumb::compare
