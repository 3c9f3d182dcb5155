// What a picture shows around each of its pixels.
#pragma once

#include <vector>

#include "core/hit_image.h"

namespace plumb::audit {

/// The least and the greatest depth among some pixels, kNoHit for sky.
struct Neighbourhood {
  double nearest, deepest;
  bool all_hit() const { return deepest < kNoHit; }
  bool all_miss() const { return nearest == kNoHit; }
};

/// A neighbourhood for each pixel, row by row.
struct Neighbourhoods {
  std::vector<double> nearest, deepest;
  Neighbourhood operator[](std::size_t pixel) const { return {nearest[pixel], deepest[pixel]}; }
};

/// Of the square of 2 radius + 1 pixels around each pixel, as far as the picture reaches.
Neighbourhoods neighbourhoods(const HitImage& image, int radius);

}  // namespace plumb::audit
