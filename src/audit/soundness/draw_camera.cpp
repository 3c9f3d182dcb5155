// Cameras: near and inside, far away, through every lens.
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "audit/soundness/draw_parts.h"
#include "core/box.h"
#include "core/reproducible_math.h"
#include "terrain/camera_presets.h"

namespace plumb::audit::soundness {
namespace {

constexpr double kLargestOffset = 1.2;  // of the picture's centre, in halves of its side

// The terrain as cameras are placed by it; places are relative to its origin.
struct Site {
  const terrain::Heightfield& field;
  Box box;             // of the heights; of the ground plan at height 0 where all is void
  double reach_m = 1;  // longest side of it
  double spacing_m = 1;

  int column_at(double x_m) const {
    return std::clamp(static_cast<int>(std::lround(x_m / field.dx_m)), 0, field.columns() - 1);
  }
  int row_at(double y_m) const {
    return std::clamp(static_cast<int>(std::lround(y_m / field.dy_m)), 0, field.rows() - 1);
  }
  /// Of a sample, or the box's middle where it is void.
  double height_at(int i, int j) const {
    return field.is_void(i, j) ? 0.5 * (box.low.z + box.high.z)
                               : static_cast<double>(field.heights_m(i, j));
  }
  double height_near(double x_m, double y_m) const {
    return height_at(column_at(x_m), row_at(y_m));
  }
  glm::dvec3 within(RandomNumbers& random, double low, double high) const {
    const glm::dvec3 part(random.uniform(low, high), random.uniform(low, high),
                          random.uniform(low, high));
    return box.low + part * (box.high - box.low);
  }
};

Site site_of(const terrain::Heightfield& field) {
  Site site{field, bounds(field), 1.0, std::min(field.dx_m, field.dy_m)};
  if (site.box.empty())
    site.box = {{0.0, 0.0, 0.0},
                {field.cell_columns() * field.dx_m, field.cell_rows() * field.dy_m, 0.0}};
  const glm::dvec3 size = site.box.high - site.box.low;
  site.reach_m = std::max({size.x, size.y, size.z, site.spacing_m});
  return site;
}

struct View {
  glm::dvec3 eye{0.0}, target{0.0};
};

glm::dvec3 direction(RandomNumbers& random, double lowest_deg, double highest_deg) {
  const double azimuth = random.uniform(0.0, 2.0 * kPi);
  const double rise = radians(random.uniform(lowest_deg, highest_deg));
  const double level = reproducible_cos(rise);
  return {level * reproducible_cos(azimuth), level * reproducible_sin(azimuth),
          reproducible_sin(rise)};
}

View orbit(RandomNumbers& random, const Site& site) {
  const glm::dvec3 target = site.within(random, 0.1, 0.9);
  return {target + site.reach_m * random.log_uniform(0.05, 5.0) * direction(random, 3.0, 89.0),
          target};
}

View near_ground(RandomNumbers& random, const Site& site) {
  View view;
  view.eye = site.within(random, -0.02, 1.02);
  view.eye.z =
      site.height_near(view.eye.x, view.eye.y) + site.spacing_m * random.log_uniform(1e-3, 10.0);
  view.target = view.eye + site.reach_m * direction(random, -40.0, 20.0);
  return view;
}

// Exact places: rays through vertices, along edges and columns of samples.
View at_sample(RandomNumbers& random, const Site& site) {
  const auto sample = [&](double above_m) {
    const int i = random.integer(0, site.field.columns() - 1);
    const int j = random.integer(0, site.field.rows() - 1);
    return glm::dvec3(i * site.field.dx_m, j * site.field.dy_m, site.height_at(i, j) + above_m);
  };
  const double above = random.chance(0.25) ? 0.0 : site.spacing_m * random.integer(1, 8);
  View view{sample(above), sample(random.chance(0.5) ? 0.0 : above)};
  if (random.chance(0.3)) view.target.x = view.eye.x;
  return view;
}

View inside(RandomNumbers& random, const Site& site) {
  return {site.within(random, 0.05, 0.95), site.within(random, -0.1, 1.1)};
}

View underground(RandomNumbers& random, const Site& site) {
  View view{site.within(random, -0.2, 1.2), site.within(random, 0.1, 0.9)};
  view.eye.z = site.box.low.z - site.reach_m * random.log_uniform(1e-3, 2.0);
  return view;
}

View grazing(RandomNumbers& random, const Site& site) {
  const glm::dvec3 size = site.box.high - site.box.low;
  View view;
  view.target = site.within(random, 0.2, 0.8);
  view.eye = view.target + 0.7 * site.reach_m * direction(random, 0.0, 0.0);
  view.eye.z = site.box.low.z + size.z * random.uniform(0.3, 1.3) +
               site.spacing_m * random.uniform(0.0, 0.1);
  view.target.z =
      view.eye.z - (random.chance(0.3) ? 0.0 : site.reach_m * random.uniform(0.0, 0.05));
  return view;
}

View straight_down(RandomNumbers& random, const Site& site) {
  View view;
  view.target = site.within(random, 0.0, 1.0);
  view.eye = view.target;
  view.eye.z = site.box.high.z + site.reach_m * random.log_uniform(0.01, 3.0);
  return view;
}

View far_away(RandomNumbers& random, const Site& site) {
  const glm::dvec3 target = site.within(random, 0.2, 0.8);
  return {target + site.reach_m * random.log_uniform(10.0, 1e4) * direction(random, 1.0, 85.0),
          target};
}

View away(RandomNumbers& random, const Site& site) {
  View view;
  view.eye = site.within(random, -0.2, 1.2);
  view.eye.z = site.box.high.z + site.reach_m * random.uniform(0.01, 1.0);
  view.target = view.eye + site.reach_m * direction(random, 5.0, 90.0);
  return view;
}

View draw_view(RandomNumbers& random, const Site& site, Placement placement) {
  switch (placement) {
    case Placement::NearGround:
      return near_ground(random, site);
    case Placement::AtSample:
      return at_sample(random, site);
    case Placement::Inside:
      return inside(random, site);
    case Placement::Underground:
      return underground(random, site);
    case Placement::Grazing:
      return grazing(random, site);
    case Placement::StraightDown:
      return straight_down(random, site);
    case Placement::FarAway:
      return far_away(random, site);
    case Placement::Away:
      return away(random, site);
    default:
      return orbit(random, site);
  }
}

double draw_fov_deg(RandomNumbers& random, const Site& site, const View& view,
                    Placement placement) {
  const double distance = glm::distance(view.eye, view.target);
  if (placement == Placement::FarAway && distance > 0.0) {  // so that some pixels see the terrain
    const double whole = 2.0 * reproducible_atan(site.reach_m / distance) * 180.0 / kPi;
    return std::clamp(rounded(whole * random.uniform(0.2, 1.5), 4), 1e-4, 120.0);
  }
  switch (random.weighted({0.6, 0.2, 0.2})) {
    case 0:
      return rounded(random.uniform(25.0, 95.0), 4);
    case 1:
      return rounded(random.log_uniform(0.3, 25.0), 4);
    default:
      return rounded(random.uniform(95.0, 172.0), 4);
  }
}

// The same view by an engine's matrices, its centre off the picture's middle.
EngineCamera off_centre(RandomNumbers& random, const Camera& c) {
  EngineCamera engine;
  engine.layout = MatrixLayout::RowMajor;
  engine.world_origin_m = c.eye_m;
  engine.view = {c.right.x,    c.right.y,    c.right.z,    0.0, c.up.x, c.up.y, c.up.z, 0.0,
                 -c.forward.x, -c.forward.y, -c.forward.z, 0.0, 0.0,    0.0,    0.0,    1.0};
  const auto offset = [&] { return rounded(random.uniform(-kLargestOffset, kLargestOffset), 4); };
  const double x = offset(), y = offset();
  engine.projection = {2.0 * c.gamma_h / c.width_px,
                       0.0,
                       x,
                       0.0,
                       0.0,
                       2.0 * c.gamma_v / c.height_px,
                       y,
                       0.0,
                       0.0,
                       0.0,
                       -1.0,
                       -2.0 * c.near_m,
                       0.0,
                       0.0,
                       -1.0,
                       0.0};
  return engine;
}

void draw_planes(RandomNumbers& random, const Site& site, CameraDescription& camera) {
  camera.near_m = rounded(site.reach_m * random.log_uniform(1e-5, 1.0), 4);
  if (random.chance(0.6))
    camera.far_m = rounded(*camera.near_m + site.reach_m * random.log_uniform(0.1, 10.0), 5);
}

glm::dvec3 rounded_place(const glm::dvec3& place, Placement placement) {
  if (placement == Placement::AtSample) return place;
  return {rounded(place.x, 12), rounded(place.y, 12), rounded(place.z, 9)};
}

Placement draw_placement(RandomNumbers& random) {
  // preset, orbit, near ground, at a sample, inside, underground, grazing, down, far, away
  return static_cast<Placement>(
      random.weighted({0.2, 0.18, 0.13, 0.1, 0.1, 0.07, 0.1, 0.06, 0.05, 0.01}));
}

void describe_eye(const Site& site, const Camera& camera, Traits& traits) {
  const glm::dvec3 eye = camera.eye_m - site.field.world_origin_m();
  const bool is_over = eye.x >= 0.0 && eye.x <= site.field.cell_columns() * site.field.dx_m &&
                       eye.y >= 0.0 && eye.y <= site.field.cell_rows() * site.field.dy_m;
  traits.below_ground = is_over && eye.z < site.height_near(eye.x, eye.y);
}

}  // namespace

void draw_camera(RandomNumbers& random, const terrain::Heightfield& field, Scene& scene,
                 Traits& traits) {
  const Site site = site_of(field);
  CameraDescription& camera = scene.camera;
  camera.width_px = static_cast<int>(random.log_uniform(16.0, 161.0));
  camera.height_px = static_cast<int>(random.log_uniform(16.0, 161.0));
  traits.placement = draw_placement(random);
  const View view = draw_view(random, site, traits.placement);
  camera.fov_y_deg = draw_fov_deg(random, site, view, traits.placement);
  if (traits.placement == Placement::Preset) {
    camera.preset = random.one_of(terrain::preset_help()).name;
  } else {
    const glm::dvec3 origin = field.world_origin_m();
    camera.eye_m = rounded_place(origin + view.eye, traits.placement);
    camera.target_m = rounded_place(origin + view.target, traits.placement);
    if (*camera.eye_m == *camera.target_m) camera.target_m->z -= site.spacing_m;
    traits.rolled = random.chance(0.12);
    if (traits.rolled) {
      const glm::dvec3 up = direction(random, -90.0, 90.0);
      camera.up = {rounded(up.x, 4), rounded(up.y, 4), rounded(up.z, 4)};
    }
  }
  traits.clipped = random.chance(0.12);
  if (traits.clipped) draw_planes(random, site, camera);
  traits.tilted = random.chance(0.05);
  if (traits.tilted) camera.tilt_deg = rounded(random.uniform(-180.0, 180.0), 4);
  const Camera placed = place_camera(camera, field).camera;
  traits.fov_y_deg = *camera.fov_y_deg;
  describe_eye(site, placed, traits);
  traits.off_centre = random.chance(0.12);
  if (!traits.off_centre) return;
  CameraDescription by_matrices;
  by_matrices.engine = off_centre(random, placed);
  by_matrices.width_px = camera.width_px;
  by_matrices.height_px = camera.height_px;
  if (traits.clipped) {
    by_matrices.near_m = placed.near_m;
    if (std::isfinite(placed.far_m)) by_matrices.far_m = placed.far_m;
  }
  camera = by_matrices;
}

}  // namespace plumb::audit::soundness
