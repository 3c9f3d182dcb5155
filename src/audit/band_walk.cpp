#include "audit/band_walk.h"

#include <algorithm>
#include <cmath>

#include "audit/grid_crossings.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr double kSameDepth = 1e-6;  // relative; two casts of one point
constexpr double kFirstCells = 8.0;  // of a walk, most of which end there

}  // namespace

BandWalk::BandWalk(const HeightfieldTruth& truth, const Camera& camera, const Band& band)
    : truth_(truth), local_(relative_to(camera, truth.field().world_origin_m())), band_(band) {}

// In pieces, each longer than the one before.
BandWalk::Way BandWalk::follow(const glm::dvec3& from, const glm::dvec3& to, Side side) const {
  const glm::dvec3 all = to - from;
  const double cells =
      std::abs(all.x) / truth_.field().dx_m + std::abs(all.y) / truth_.field().dy_m;
  double begin = 0.0, length = cells > kFirstCells ? kFirstCells / cells : 1.0;
  Way way = Way::Unknown;
  while (way == Way::Unknown && begin < 1.0) {
    const double end = std::min(1.0, begin + length);
    way = follow_piece(from + begin * all, from + end * all, side);
    begin = end;
    length *= 2.0;
  }
  return way;
}

BandWalk::Way BandWalk::follow_piece(const glm::dvec3& from, const glm::dvec3& to,
                                     Side side) const {
  Way way = Way::Unknown;
  glm::dvec3 before = from;
  GridCrossings(truth_.field(), truth_.diagonal()).between(from, to, [&](const glm::dvec3& at) {
    if (way != Way::Unknown) return;
    const glm::dvec3 middle = 0.5 * (before + at);
    before = at;
    if (std::isnan(truth_.height_at(middle.x, middle.y))) {
      way = Way::Open;
    } else if (is_beyond(at, side)) {
      way = Way::Blocked;
    }
  });
  return way;
}

bool BandWalk::is_beyond(const glm::dvec3& point, Side side) const {
  const double height = truth_.height_at(point.x, point.y);
  const double off = side == Side::Below ? height - point.z : point.z - height;
  if (!(off > band_.metres + truth_.slack_m)) return false;
  return screen_displacement_px(local_, {point.x, point.y, height}, kUp, point.z - height) >
         band_.pixels * (1.0 + kSameDepth);
}

bool BandWalk::keeps(const glm::dvec3& point) const {
  return !std::isnan(truth_.height_at(point.x, point.y)) && !is_beyond(point, Side::Below) &&
         !is_beyond(point, Side::Above);
}

}  // namespace plumb::audit
