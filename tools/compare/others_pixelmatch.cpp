#include "compare/others_pixelmatch.h"

#include <algorithm>
#include <cmath>

#include "compare/others_rules.h"
#include "core/check.h"
#include "core/parallel.h"

namespace plumb::compare {
namespace {

using image::Rgb8Image;

constexpr double kLargestSquared = 35215.0;  // of a distance, as the source has it

struct ColourStep {
  int r, g, b;
};

ColourStep step(const std::uint8_t* from, const std::uint8_t* to) {
  return {from[0] - to[0], from[1] - to[1], from[2] - to[2]};
}

double luma(const ColourStep& d) { return d.r * 0.29889531 + d.g * 0.58662247 + d.b * 0.11448223; }

double squared_distance(const ColourStep& d) {
  const double y = luma(d);
  const double i = d.r * 0.59597799 - d.g * 0.27417610 - d.b * 0.32180189;
  const double q = d.r * 0.21147017 - d.g * 0.52261711 + d.b * 0.31114694;
  return 0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q;
}

const std::uint8_t* at(const Rgb8Image& picture, int x, int y) {
  return &picture
              .rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                        static_cast<std::size_t>(x))];
}

bool same(const std::uint8_t* a, const std::uint8_t* b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// The 3 x 3 pixels around one, as far as the picture reaches; a border stands for one equal pixel.
struct Around {
  int left, right, top, bottom;
  int equal_at_first;

  Around(const Rgb8Image& picture, int x, int y)
      : left(std::max(x - 1, 0)),
        right(std::min(x + 1, picture.width_px - 1)),
        top(std::max(y - 1, 0)),
        bottom(std::min(y + 1, picture.height_px - 1)),
        equal_at_first(right - left < 2 || bottom - top < 2 ? 1 : 0) {}
};

// Whether three or more of the neighbours have the pixel's colour.
bool in_even_area(const Rgb8Image& picture, int x, int y) {
  const Around around(picture, x, y);
  const std::uint8_t* colour = at(picture, x, y);
  int equal = around.equal_at_first;
  for (int j = around.top; j <= around.bottom; ++j) {
    for (int i = around.left; i <= around.right; ++i) {
      if ((i != x || j != y) && same(colour, at(picture, i, j))) ++equal;
    }
  }
  return equal > 2;
}

struct Place {
  int x = 0, y = 0;
};

// A pixel between a darker and a brighter one, one of which lies in an even area of both pictures.
// Of equally dark or bright ones the first counts, column by column, as in the source.
bool looks_smoothed(const Rgb8Image& picture, const Rgb8Image& other, int x, int y) {
  const Around around(picture, x, y);
  const std::uint8_t* colour = at(picture, x, y);
  int equal = around.equal_at_first;
  double least = 0.0, largest = 0.0;
  Place brightest, darkest;
  for (int i = around.left; i <= around.right; ++i) {
    for (int j = around.top; j <= around.bottom; ++j) {
      if (i == x && j == y) continue;
      const double difference = luma(step(colour, at(picture, i, j)));
      if (difference == 0.0) {
        if (++equal > 2) return false;
      } else if (difference < least) {
        least = difference;
        brightest = {i, j};
      } else if (difference > largest) {
        largest = difference;
        darkest = {i, j};
      }
    }
  }
  if (least == 0.0 || largest == 0.0) return false;
  const auto even_in_both = [&](const Place& place) {
    return in_even_area(picture, place.x, place.y) && in_even_area(other, place.x, place.y);
  };
  return even_in_both(brightest) || even_in_both(darkest);
}

}  // namespace

PixelmatchCounts pixelmatch_counts(const Rgb8Image& reference, const Rgb8Image& candidate,
                                   double threshold) {
  require_judgeable(reference, candidate);
  require(threshold >= 0.0 && threshold <= 1.0, "threshold must be in [0, 1], got {}", threshold);
  const double limit = kLargestSquared * threshold * threshold;
  return parallel_ordered_reduce(
      reference.height_px, 16, PixelmatchCounts{},
      [&](std::int64_t begin, std::int64_t end, PixelmatchCounts counts) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
          for (int x = 0; x < reference.width_px; ++x) {
            const std::uint8_t *a = at(reference, x, y), *b = at(candidate, x, y);
            if (same(a, b) || !(squared_distance(step(a, b)) > limit)) continue;
            ++counts.all;
            if (!looks_smoothed(reference, candidate, x, y) &&
                !looks_smoothed(candidate, reference, x, y))
              ++counts.remaining;
          }
        }
        return counts;
      },
      [](const PixelmatchCounts& a, const PixelmatchCounts& b) {
        return PixelmatchCounts{a.all + b.all, a.remaining + b.remaining};
      });
}

}  // namespace plumb::compare
