#include "audit/scene_picture.h"

#include <chrono>
#include <memory>
#include <utility>

#include "audit/picture.h"
#include "core/memory.h"
#include "raster/rasteriser.h"
#include "reference/pyramid_caster.h"
#include "terrain/terrain_source.h"

namespace plumb::audit {
namespace {

// Hits, normals, patches and levels, colours and channels of a pixel, and a file's copy of them.
constexpr std::int64_t kBytesPerPixel =
    sizeof(double) + sizeof(glm::dvec3) + sizeof(std::uint32_t) + sizeof(std::uint16_t) +
    sizeof(glm::dvec3) + 2 * sizeof(int) + (3 + 13 + 13) * sizeof(float);

class Clock {
 public:
  double lap_s() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> taken = now - start_;
    start_ = now;
    return taken.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

PictureMaker maker_of(const Scene& scene, terrain::Diagonal diagonal,
                      const std::string& program_version) {
  PictureMaker maker;
  maker.diagonal = diagonal;
  maker.program_version = program_version;
  maker.scene_toml = to_toml(scene);
  maker.method = "truth";
  if (scene.painter == Painter::Truth) return maker;
  maker.method = scene.method;
  maker.variant = scene.choice.variant;
  maker.parameters = scene.choice.parameters;
  maker.tolerance = scene.tolerance;
  return maker;
}

void draw_truth(DrawnScene& drawn, terrain::Diagonal diagonal, Clock& clock) {
  const reference::PyramidCaster caster(drawn.field, diagonal);
  drawn.times.prepare_s = clock.lap_s();
  drawn.hits = caster.cast_frame(drawn.camera);
  drawn.times.draw_s = clock.lap_s();
}

void draw_method(DrawnScene& drawn, const Method& method, Clock& clock) {
  const Scene& scene = drawn.scene;
  const std::unique_ptr<PreparedMethod> prepared =
      prepare_method(method, drawn.field, scene.choice, scene.tolerance);
  drawn.times.prepare_s = clock.lap_s();
  drawn.surface = prepared->draw(drawn.camera, scene.tolerance);
  raster::RasterResult raster = raster::rasterise(*drawn.surface.mesh, drawn.camera);
  drawn.hits = std::move(raster.image);
  drawn.surface.cost.fragments = raster.fragments;
  drawn.times.draw_s = clock.lap_s();
}

}  // namespace

DrawnScene draw_scene(const Scene& scene, const MethodTable& table,
                      const std::string& program_version, const StepListener& on_step) {
  if (!scene.method.empty()) find_method(table, scene.method);  // before the terrain is read
  Clock clock;
  if (on_step) on_step("reading the terrain");
  terrain::Heightfield field = terrain::load_terrain(scene.terrain, scene.read);
  const double read_s = clock.lap_s();
  DrawnScene drawn = draw_scene_on(std::move(field), scene, table, program_version, on_step);
  drawn.times.read_s = read_s;
  return drawn;
}

DrawnScene draw_scene_on(terrain::Heightfield field, const Scene& scene, const MethodTable& table,
                         const std::string& program_version, const StepListener& on_step) {
  const auto step = [&](const std::string& what) {
    if (on_step) on_step(what);
  };
  const bool by_rays = scene.painter == Painter::Truth;
  const Method* method = scene.method.empty() ? nullptr : &find_method(table, scene.method);
  if (method == nullptr && !by_rays) input_error("a scene needs a method, or the truth");
  DrawnScene drawn;
  drawn.scene = scene;
  drawn.field = std::move(field);
  drawn.scene.terrain = drawn.field.provenance.source;
  Clock clock;
  step("placing the camera");
  const PlacedCamera placed = place_camera(scene.camera, drawn.field);
  drawn.camera = placed.camera;
  drawn.scene.camera = placed.description;
  const int width_px = drawn.camera.width_px, height_px = drawn.camera.height_px;
  require_memory(kBytesPerPixel * width_px * height_px,
                 fmt::format("a picture of {} x {} pixels", width_px, height_px));
  terrain::Diagonal diagonal = method != nullptr ? method->truth : terrain::Diagonal::Alternating;
  if (!scene.diagonal.empty()) diagonal = terrain::parse_diagonal(scene.diagonal);
  drawn.scene.diagonal = name_of(diagonal);
  if (by_rays) {
    step("casting rays");
    draw_truth(drawn, diagonal, clock);
  } else {
    if (scene.choice.variant.empty()) drawn.scene.choice.variant = method->variants.front();
    step("drawing the surface");
    draw_method(drawn, *method, clock);
  }
  step("making the picture");
  const PictureMaker maker = maker_of(drawn.scene, diagonal, program_version);
  drawn.picture = by_rays
                      ? draw_truth_picture(drawn.field, drawn.hits, drawn.camera, maker)
                      : draw_picture(drawn.field, drawn.hits, drawn.surface, drawn.camera, maker);
  drawn.times.picture_s = clock.lap_s();
  return drawn;
}

}  // namespace plumb::audit
