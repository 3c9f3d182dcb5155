// Written once for every number of lanes; see reference/lane_walk_kernel.h for who may include it.
#pragma once

#include <limits>

#include "audit/project_samples.h"

namespace plumb::audit {
namespace {

// Points of one row in view coordinates.
template <class L>
struct ViewPoints {
  typename L::Real across, upwards, depth;
};

// to_view, with what a row's samples share worked out before.
template <class L>
class RowToView {
 public:
  RowToView(const Camera& c, const SampleRun& run)
      : dx_m_(L::all(run.dx_m)),
        eye_x_(L::all(c.eye_m.x)),
        eye_z_(L::all(c.eye_m.z)),
        right_x_(L::all(c.right.x)),
        right_y_(L::all((run.y_m - c.eye_m.y) * c.right.y)),
        right_z_(L::all(c.right.z)),
        up_x_(L::all(c.up.x)),
        up_y_(L::all((run.y_m - c.eye_m.y) * c.up.y)),
        up_z_(L::all(c.up.z)),
        forward_x_(L::all(c.forward.x)),
        forward_y_(L::all((run.y_m - c.eye_m.y) * c.forward.y)),
        forward_z_(L::all(c.forward.z)) {}

  ViewPoints<L> operator()(typename L::Real column, typename L::Real height_m) const {
    const auto x = column * dx_m_ - eye_x_, z = height_m - eye_z_;
    return {x * right_x_ + right_y_ + z * right_z_, x * up_x_ + up_y_ + z * up_z_,
            x * forward_x_ + forward_y_ + z * forward_z_};
  }

 private:
  typename L::Real dx_m_, eye_x_, eye_z_;
  typename L::Real right_x_, right_y_, right_z_, up_x_, up_y_, up_z_, forward_x_, forward_y_,
      forward_z_;
};

// A millionth of the depth stands for a vertical metre, which may reach behind the eye. Divided
// only where it may be the largest.
template <class L>
void raise_pixels_per_metre(typename L::Mask asked, typename L::Real speed, typename L::Real depth,
                            double up_z, double& pixels_per_metre) {
  const auto small = L::all(1e-6) * depth, moved = depth + small * L::all(up_z);
  const auto larger = L::less(L::all(pixels_per_metre) * depth * moved, speed * L::all(1.0 + 1e-9));
  if (L::bits(L::both(asked, larger)) == 0) return;
  double most[L::kCount];
  L::store(most, L::choose(asked, small * speed / (depth * moved) / small, L::all(0.0)));
  for (const double lane : most)
    pixels_per_metre = lane > pixels_per_metre ? lane : pixels_per_metre;
}

template <class L>
void project_samples_of(const ProjectingCamera& projecting, const SampleRun& run,
                        ProjectedSamples& to, double& pixels_per_metre) {
  using Real = typename L::Real;
  static constexpr double kAhead[8] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  const Camera& c = projecting.camera;
  const glm::dvec3& up = projecting.up;
  const RowToView<L> to_view(c, run);
  const Real zero = L::all(0.0), one = L::all(1.0);
  const Real nothing = L::all(std::numeric_limits<double>::quiet_NaN()),
             infinite = L::all(std::numeric_limits<double>::infinity());
  const Real width = L::all(c.width_px), height = L::all(c.height_px), end = L::all(run.count);
  for (int k = 0; k < run.count; k += L::kCount) {
    const Real ahead = L::all(k) + L::load(kAhead);
    const Real height_m = L::load(run.heights_m + k), delta = L::load(run.delta_m + k);
    const auto drawn = L::both(L::less_equal(zero, L::load(run.triangle + k)),
                               L::both(L::equal(height_m, height_m), L::less(ahead, end)));
    const Real metres = L::magnitude(delta);
    L::store(to.metres + k, L::choose(drawn, metres, nothing));

    const ViewPoints<L> at = to_view(L::all(run.first) + ahead, height_m);
    const Real x = L::all(c.centre_px.x) + L::all(c.gamma_h) * (at.across / at.depth);
    const Real y = L::all(c.centre_px.y) - L::all(c.gamma_v) * (at.upwards / at.depth);
    const auto inside = L::both(L::both(L::less_equal(zero, x), L::less_equal(x, width)),
                                L::both(L::both(L::less_equal(zero, y), L::less_equal(y, height)),
                                        L::both(L::less_equal(L::all(c.near_m), at.depth),
                                                L::less_equal(at.depth, L::all(c.far_m)))));
    const auto seen = L::both(drawn, inside);

    const Real u = L::all(c.gamma_h) * (at.depth * L::all(up.x) - L::all(up.z) * at.across);
    const Real v = L::all(c.gamma_v) * (at.depth * L::all(up.y) - L::all(up.z) * at.upwards);
    const Real speed = L::root(u * u + v * v);
    const Real moved = at.depth + delta * L::all(up.z);
    Real pixels = L::choose(L::less(zero, moved), metres * speed / (at.depth * moved), infinite);
    pixels = L::choose(L::equal(delta, zero), zero, pixels);
    L::store(to.pixels + k, L::choose(seen, pixels, nothing));
    L::store(to.depth_m + k, at.depth);
    // A place on the image's right or lower rim belongs to the last pixel.
    L::store_whole(to.column + k, L::greatest(L::least(x, width - one), zero));
    L::store_whole(to.row + k, L::greatest(L::least(y, height - one), zero));
    raise_pixels_per_metre<L>(seen, speed, at.depth, up.z, pixels_per_metre);
  }
}

}  // namespace
}  // namespace plumb::audit
