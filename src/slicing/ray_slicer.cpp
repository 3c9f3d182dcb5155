#include "slicing/ray_slicer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "slicing/branch_walk.h"
#include "slicing/slice_packet.h"

namespace plumb::slicing {
namespace {

// Pixels of a packet.
constexpr int kColumns = 4, kRows = 2;
static_assert(kColumns * kRows == SlicePacket::kMost);

struct PixelBlock {
  int x0, y0, columns, rows;

  // Calls with(k, x, y) for each pixel, row by row.
  template <class With>
  void for_each(const With& with) const {
    int k = 0;
    for (int y = y0; y < y0 + rows; ++y) {
      for (int x = x0; x < x0 + columns; ++x) with(k++, x, y);
    }
  }
};

class RaySlicer {
 public:
  RaySlicer(const SlicingCut& cut, const HeightLookup& heights, double near_m, double far_m)
      : cut_(cut), heights_(heights), all_{near_m, far_m} {}

  SliceHit cast(const SliceRay& ray, std::int32_t& tested) const {
    SliceHit best;
    walk_bundles(cut_, ray, all_, best.t, [&](std::uint32_t bundle, const Interval& part) {
      meet_bundle(bundle, ray, part, best, tested);
    });
    return best;
  }

 private:
  void meet_bundle(std::uint32_t number, const SliceRay& ray, const Interval& part, SliceHit& best,
                   std::int32_t& tested) const {
    const SliceBundle& bundle = cut_.bundles[number];
    if (bundle.closed) meet_closing_quads(number, ray, best, tested);
    const auto [low, high] = planes_within(bundle, ray, part);
    const double step = ray.direction[index_of(bundle.axis)];
    for (int k = 0; k <= high - low; ++k) {
      const int j = step > 0.0 ? low + k : high - k;
      if (meet_quad(number, QuadKind::Slice, bundle.axis, bundle.plane_m(j), ray, best, tested))
        return;
    }
  }

  void meet_closing_quads(std::uint32_t number, const SliceRay& ray, SliceHit& best,
                          std::int32_t& tested) const {
    for_each_closing_quad(cut_.bundles[number], [&](Axis axis, double at_m) {
      meet_quad(number, QuadKind::Closing, axis, at_m, ray, best, tested);
    });
  }

  // True if no plane behind this one can be nearer than the best.
  bool meet_quad(std::uint32_t number, QuadKind kind, Axis axis, double at_m, const SliceRay& ray,
                 SliceHit& best, std::int32_t& tested) const {
    const SliceBundle& bundle = cut_.bundles[number];
    if (ray.direction[index_of(axis)] == 0.0) return false;
    const PlanePoint met = meet_plane(ray, axis, at_m);
    if (met.t > best.t) return true;
    if (!(met.t >= all_.begin && met.t <= all_.end) || !is_on_quad(bundle, kind, axis, met.point_m))
      return false;
    ++tested;
    if (!passes(bundle, kind, axis, heights_, ray, met)) return false;
    best = std::min(best, SliceHit{met.t, number});
    return true;
  }

  const SlicingCut& cut_;
  const HeightLookup& heights_;
  Interval all_;  // near and far
};

// Packets of rays in lanes where the lookup allows it.
class PacketSlicer {
 public:
  PacketSlicer(const SlicingCut& cut, const Camera& camera, const HeightLookup& heights)
      : one_by_one_(cut, heights, camera.near_m, camera.far_m),
        slice_packets_(slice_packets(instruction_set())) {
    const std::optional<LaneHeights> lane_heights = heights.for_lanes();
    in_lanes_ = lane_heights && !cut.branches.empty();
    if (!in_lanes_) return;
    scene_.branches = cut.branches.data();
    scene_.root = static_cast<std::uint32_t>(cut.branches.size()) - 1;
    scene_.bundles = cut.bundles.data();
    scene_.heights = *lane_heights;
    for (int k = 0; k < 3; ++k) scene_.eye_m[k] = camera.eye_m[k];
    scene_.near_t = camera.near_m;
    scene_.far_t = camera.far_m;
    // 2^7 roundings: a fragment's and its ground's take fewer than 30.
    scene_.rounding_m =
        std::ldexp(greatest_coordinate_m(cut.branches.back().reach, camera.eye_m), -45);
  }

  // The rays of pixels side by side, whose directions and their inverses the packet has.
  void cast(const Camera& camera, const PixelBlock& block, SlicePacket& packet) const {
    std::array<int, SlicePacket::kMost> kind;
    bool alike = in_lanes_;
    for (int k = 0; k < packet.count; ++k) {
      kind[static_cast<std::size_t>(k)] = in_lanes_ ? kind_of(packet, k) : kAlone;
      alike = alike && kind[static_cast<std::size_t>(k)] == kind[0];
    }
    if (alike && kind[0] != kAlone) {
      slice_packets_(scene_, packet);
      return;
    }
    for (int quadrant = 0; quadrant < kAlone; ++quadrant) cast_some(kind, quadrant, packet);
    block.for_each([&](int k, int x, int y) {
      if (kind[static_cast<std::size_t>(k)] != kAlone) return;
      packet.tested[k] = 0;
      const SliceHit hit = one_by_one_.cast(SliceRay(camera, x, y), packet.tested[k]);
      packet.t[k] = hit.t;
      packet.bundle[k] = hit.bundle;
    });
  }

 private:
  // The quadrant that a ray runs to, 0 .. 3; kAlone if lanes are not for it.
  static constexpr int kAlone = 4;
  static int kind_of(const SlicePacket& packet, int k) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(packet.direction[axis][k]) < SlicePacket::kStill) return kAlone;
    }
    return (packet.direction[0][k] < 0.0 ? 1 : 0) + (packet.direction[1][k] < 0.0 ? 2 : 0);
  }

  // Those of the packet's rays that are of one kind.
  void cast_some(const std::array<int, SlicePacket::kMost>& kind, int wanted,
                 SlicePacket& packet) const {
    std::array<int, SlicePacket::kMost> from;
    SlicePacket some;
    for (int k = 0; k < packet.count; ++k) {
      if (kind[static_cast<std::size_t>(k)] != wanted) continue;
      for (int axis = 0; axis < 3; ++axis) {
        some.direction[axis][some.count] = packet.direction[axis][k];
        some.inverse[axis][some.count] = packet.inverse[axis][k];
      }
      from[static_cast<std::size_t>(some.count++)] = k;
    }
    if (some.count == 0) return;
    slice_packets_(scene_, some);
    for (int k = 0; k < some.count; ++k) {
      const int to = from[static_cast<std::size_t>(k)];
      packet.t[to] = some.t[k];
      packet.bundle[to] = some.bundle[k];
      packet.tested[to] = some.tested[k];
    }
  }

  RaySlicer one_by_one_;
  SlicePackets slice_packets_;
  bool in_lanes_ = false;
  PacketScene scene_;
};

// Casts a packet; returns the fragments tested.
std::int64_t slice_pixels(const PacketSlicer& slicer, const Camera& camera, const PixelBlock& block,
                          HitImage& image) {
  SlicePacket packet;
  packet.count = block.columns * block.rows;
  block.for_each([&](int k, int x, int y) {
    const glm::dvec3 direction = ray_direction(camera, x + 0.5, y + 0.5);
    for (int axis = 0; axis < 3; ++axis) {
      packet.direction[axis][k] = direction[axis];
      packet.inverse[axis][k] = 1.0 / direction[axis];
    }
  });
  slicer.cast(camera, block, packet);
  std::int64_t tested = 0;
  block.for_each([&](int k, int x, int y) {
    const std::size_t pixel = image.index(x, y);
    tested += packet.tested[k];
    image.overdraw[pixel] = static_cast<std::uint16_t>(std::min(packet.tested[k], 65535));
    if (packet.bundle[k] == kNoPrimitive) return;
    image.depth_m[pixel] = packet.t[k];
    image.from_eye_m[pixel] =
        packet.t[k] *
        glm::dvec3(packet.direction[0][k], packet.direction[1][k], packet.direction[2][k]);
    image.primitive[pixel] = packet.bundle[k];
  });
  return tested;
}

}  // namespace

SlicedImage slice_rays(const SlicingCut& cut, const Camera& camera, const HeightLookup& heights) {
  SlicedImage result;
  result.image = HitImage(camera.width_px, camera.height_px);
  result.image.overdraw.assign(result.image.size(), 0);
  const PacketSlicer slicer(cut, camera, heights);
  const int bands = (camera.height_px + kRows - 1) / kRows;
  std::vector<std::int64_t> tested(static_cast<std::size_t>(bands), 0);
  parallel_for(bands, 2, [&](std::int64_t band) {
    for (int x = 0; x < camera.width_px; x += kColumns) {
      const int y = static_cast<int>(band) * kRows;
      const PixelBlock block{x, y, std::min(kColumns, camera.width_px - x),
                             std::min(kRows, camera.height_px - y)};
      tested[static_cast<std::size_t>(band)] += slice_pixels(slicer, camera, block, result.image);
    }
  });
  for (const std::int64_t of_band : tested) result.fragments += of_band;
  return result;
}

}  // namespace plumb::slicing
