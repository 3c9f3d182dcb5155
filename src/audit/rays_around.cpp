#include "audit/rays_around.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/coverage_parts.h"
#include "reference/beam_end.h"

namespace plumb::audit {
namespace {

constexpr int kCoarse = 8;     // every so manieth ray along each axis is cast first
constexpr int kBlock = 16;     // rays along the side of what is cast together
constexpr int kManyRays = 24;  // along an axis: where looking for rays to leave out pays
static_assert(kBlock * kBlock <= reference::CameraRays::Batch::kMost);
static_assert((kMostRays / kCoarse) * (kMostRays / kCoarse) <= reference::CameraRays::Batch::kMost);

bool has_voids(const terrain::Heightfield& field) {
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      if (field.is_void(i, j)) return true;
    }
  }
  return false;
}

template <class Wanted>
bool any_of(reference::CameraRays::Batch& batch, const Wanted& wanted) {
  batch.cast();
  for (int k = 0; k < batch.count(); ++k) {
    if (wanted(batch.hit(k))) return true;
  }
  batch.clear();
  return false;
}

}  // namespace

// The rays around a pixel.
struct RaysAround::Square {
  int x, y;
  double reach;
  RayGrid grid{reach};

  double x_px(int a) const { return grid.place(x, a); }
  double y_px(int b) const { return grid.place(y, b); }
};

RaysAround::RaysAround(const HeightfieldTruth& truth, const Camera& camera)
    : rays_(truth.caster, camera), has_voids_(has_voids(truth.field())) {}

bool RaysAround::any_hits(int x, int y, double reach) const {
  const Square square{x, y, reach};
  const auto wanted = [](const reference::RayHit& ray) { return static_cast<bool>(ray); };
  return any_of_few(square, wanted) || any_of_all(
                                           square, [](int, int) { return true; }, wanted);
}

bool RaysAround::any_passes(int x, int y, double reach, double depth_m) const {
  const Square square{x, y, reach};
  const auto wanted = [&](const reference::RayHit& ray) { return !ray || ray.t >= depth_m; };
  if (any_of_few(square, wanted)) return true;
  if (square.grid.rays < kManyRays || has_voids_)
    return any_of_all(
        square, [](int, int) { return true; }, wanted);
  return any_of_all(
      square, [&](int i, int j) { return !(latest_hit(i, j) < depth_m); }, wanted);
}

// Some rays, evenly spread: `any` does not ask for an order.
template <class Wanted>
bool RaysAround::any_of_few(const Square& square, const Wanted& wanted) const {
  if (square.grid.rays < kManyRays) return false;
  reference::CameraRays::Batch batch(rays_);
  for (int b = kCoarse / 2; b < square.grid.rays; b += kCoarse) {
    for (int a = kCoarse / 2; a < square.grid.rays; a += kCoarse)
      batch.add(square.x_px(a), square.y_px(b));
  }
  return any_of(batch, wanted);
}

// Those that go through pixels that count(i, j).
template <class Counts, class Wanted>
bool RaysAround::any_of_all(const Square& square, const Counts& counts,
                            const Wanted& wanted) const {
  reference::CameraRays::Batch batch(rays_);
  for (int b0 = 0; b0 < square.grid.rays; b0 += kBlock) {
    for (int a0 = 0; a0 < square.grid.rays; a0 += kBlock) {
      for (int b = b0; b < std::min(b0 + kBlock, square.grid.rays); ++b) {
        const double y_px = square.y_px(b);
        const int j = static_cast<int>(std::floor(y_px));
        for (int a = a0; a < std::min(a0 + kBlock, square.grid.rays); ++a) {
          const double x_px = square.x_px(a);
          if (counts(static_cast<int>(std::floor(x_px)), j)) batch.add(x_px, y_px);
        }
      }
      if (batch.count() > 0 && any_of(batch, wanted)) return true;
    }
  }
  return false;
}

// Found anew by whoever asks first; two that do at once find the same.
float RaysAround::latest_hit(int x, int y) const {
  const Camera& camera = rays_.camera();
  const auto columns = static_cast<std::size_t>(camera.width_px + 2 * kMostReach + 1),
             rows = static_cast<std::size_t>(camera.height_px + 2 * kMostReach + 1);
  std::call_once(once_, [&] {
    latest_ = std::make_unique<std::atomic<float>[]>(columns * rows);
    for (std::size_t k = 0; k < columns * rows; ++k)
      latest_[k].store(-1.0f, std::memory_order_relaxed);
  });
  const auto i = static_cast<std::size_t>(x + kMostReach),
             j = static_cast<std::size_t>(y + kMostReach);
  std::atomic<float>& kept = latest_[j * columns + i];
  float latest = kept.load(std::memory_order_relaxed);
  if (latest < 0.0f) {
    latest = found_latest_hit(x, y);
    kept.store(latest, std::memory_order_relaxed);
  }
  return latest;
}

float RaysAround::found_latest_hit(int x, int y) const {
  const reference::PyramidCaster& caster = rays_.caster();
  const reference::Beam beam = reference::camera_beam(
      rays_.camera(), caster.field().world_origin_m(), x, y, x + 1.0, y + 1.0);
  const double end = reference::beam_end(caster.field(), caster.diagonal(), caster.pyramid(), beam);
  return std::nextafter(static_cast<float>(end), std::numeric_limits<float>::infinity());
}

}  // namespace plumb::audit
