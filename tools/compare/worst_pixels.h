// The pixels that a person should look at first.
#pragma once

#include <functional>
#include <vector>

#include "compare/comparison.h"

namespace plumb::compare {

/// From every map in turn its worst pixel, then its second one, and so on: maps whose limit is
/// broken first. Two pixels of one map lie at least `kApart_px` apart, so that one defect does not
/// fill the list.
inline constexpr int kApart_px = 8;
std::vector<WorstPixel> worst_pixels(const PicturePair& pair, const std::vector<ErrorMap>& maps,
                                     int most);

/// How many of the wanted pixels are over a map's limit.
std::int64_t pixels_over_limits(const std::vector<ErrorMap>& maps,
                                const std::function<bool(std::size_t)>& wanted);

}  // namespace plumb::compare
