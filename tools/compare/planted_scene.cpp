#include "compare/planted_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/vec2.hpp>
#include <span>

#include "audit/picture.h"
#include "core/check.h"
#include "image/aov_image.h"
#include "raster/shading/shade.h"
#include "reference/pyramid_caster.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::compare {
namespace {

// Places within a pixel that no line through it meets two of: a turned grid.
constexpr double kPlaces[4][2] = {
    {-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}};

terrain::Heightfield strided(const terrain::Heightfield& field, int stride) {
  terrain::Heightfield coarse = field;
  Grid<float>& heights = coarse.heights_m.floats();
  const auto below = [&](int k) { return k / stride * stride; };
  for (int j = 0; j < field.rows(); ++j) {
    const int j0 = below(j), j1 = std::min(j0 + stride, field.rows() - 1);
    const double v = j1 > j0 ? static_cast<double>(j - j0) / (j1 - j0) : 0.0;
    for (int i = 0; i < field.columns(); ++i) {
      const int i0 = below(i), i1 = std::min(i0 + stride, field.columns() - 1);
      const double u = i1 > i0 ? static_cast<double>(i - i0) / (i1 - i0) : 0.0;
      const auto row = [&](int r) {
        return (1.0 - u) * double{field.heights_m(i0, r)} + u * double{field.heights_m(i1, r)};
      };
      heights(i, j) = static_cast<float>((1.0 - v) * row(j0) + v * row(j1));
    }
  }
  return coarse;
}

enum class Normals { Right, NorthTurned };

// How all pictures of a scene are drawn: tinted by the heights of the full terrain, whatever is
// drawn in its place.
struct Look {
  int rays_px = 1;
  raster::ShadeOptions shading;
};

// One ray a pixel.
image::AovImage draw(const reference::PyramidCaster& caster, const Camera& camera, const Look& look,
                     Normals normals) {
  const HitImage hits = caster.cast_frame(camera);
  audit::PictureMaker maker;
  maker.method = "truth";
  image::AovImage picture = audit::draw_truth_picture(caster.field(), hits, camera, maker);
  std::vector<glm::dvec3> used(picture.size());
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (normals == Normals::NorthTurned) picture.ny[k] = -picture.ny[k];
    used[k] = {double{picture.nx[k]}, double{picture.ny[k]}, double{picture.nz[k]}};
  }
  image::ColourImage colours = raster::shade(hits, camera, used, look.shading);
  picture.r = std::move(colours.r);
  picture.g = std::move(colours.g);
  picture.b = std::move(colours.b);
  return picture;
}

image::PlaneImage draw_supersampled(const reference::PyramidCaster& caster, Camera camera,
                                    const Look& look, Normals normals = Normals::Right) {
  image::AovImage picture = draw(caster, camera, look, normals);
  if (look.rays_px == 1) return image::planes_of(picture);
  const glm::dvec2 centre = camera.centre_px;
  for (auto* channel : {&picture.r, &picture.g, &picture.b})
    std::fill(channel->begin(), channel->end(), 0.0f);
  for (const auto& place : kPlaces) {
    camera.centre_px = centre - glm::dvec2(place[0], place[1]);
    const image::AovImage one = draw(caster, camera, look, normals);
    for (std::size_t k = 0; k < picture.size(); ++k) {
      picture.r[k] += 0.25f * one.r[k];
      picture.g[k] += 0.25f * one.g[k];
      picture.b[k] += 0.25f * one.b[k];
    }
  }
  return image::planes_of(picture);
}

}  // namespace

struct PlantedScene::Parts {
  explicit Parts(const PlantedSceneOptions& options)
      : field(terrain::load_terrain(fmt::format("generate:{}?size={}&seed={}", options.terrain,
                                                options.samples, options.seed),
                                    {})),
        caster(field, terrain::Diagonal::Alternating),
        camera(make_camera(terrain::preset_camera(field, options.view, options.width_px,
                                                  options.height_px, 50.0))) {
    const Box box = terrain::bounds(field);
    look.rays_px = options.rays_px;
    look.shading.low_m = box.low.z;
    look.shading.high_m = box.high.z;
  }

  Look look;
  terrain::Heightfield field;
  reference::PyramidCaster caster;
  Camera camera;
};

PlantedScene::PlantedScene(const PlantedSceneOptions& options) {
  require(options.rays_px == 1 || options.rays_px == 4, "rays_px must be 1 or 4, got {}",
          options.rays_px);
  parts_ = std::make_unique<Parts>(options);
}

PlantedScene::~PlantedScene() = default;

image::PlaneImage PlantedScene::drawn() const {
  return draw_supersampled(parts_->caster, parts_->camera, parts_->look);
}

image::PlaneImage PlantedScene::shifted(double x_px, double y_px) const {
  Camera camera = parts_->camera;
  camera.centre_px += glm::dvec2(x_px, y_px);
  return draw_supersampled(parts_->caster, camera, parts_->look);
}

image::PlaneImage PlantedScene::with_level_of_detail(int stride) const {
  require(stride >= 1, "stride must be >= 1, got {}", stride);
  const terrain::Heightfield coarse = strided(parts_->field, stride);
  const reference::PyramidCaster caster(coarse, terrain::Diagonal::Alternating);
  return draw_supersampled(caster, parts_->camera, parts_->look);
}

image::PlaneImage PlantedScene::with_wrong_normals() const {
  return draw_supersampled(parts_->caster, parts_->camera, parts_->look, Normals::NorthTurned);
}

}  // namespace plumb::compare
