#include "audit/scene_picture.h"

#include <memory>
#include <utility>

#include "audit/frame_memory.h"
#include "audit/mesh_truth.h"
#include "audit/picture.h"
#include "audit/surface_picture.h"
#include "core/stopwatch.h"
#include "image/image_files.h"
#include "reference/pyramid_caster.h"
#include "terrain/terrain_source.h"

namespace plumb::audit {
namespace {

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

const Method* method_of(const Scene& scene, const MethodTable& table) {
  if (!scene.method.empty()) return &find_method(table, scene.method);
  if (scene.painter != audit::Painter::Truth) input_error("a scene needs a method, or the truth");
  return nullptr;
}

terrain::Diagonal diagonal_of(const Scene& scene, const Method* method) {
  if (!scene.diagonal.empty()) return terrain::parse_diagonal(scene.diagonal);
  return method != nullptr ? method->truth : terrain::Diagonal::Alternating;
}

}  // namespace

// One of the three.
struct SceneDrawer::Painter {
  std::unique_ptr<const PreparedMethod> method;
  std::unique_ptr<MethodRun> run;  // of that method
  std::unique_ptr<const reference::PyramidCaster> caster;
  std::unique_ptr<const MeshTruth> solid;  // the truth of a terrain of stacks
};

SceneDrawer::SceneDrawer(terrain::Heightfield field, Scene scene, const MethodTable& table,
                         std::string program_version)
    : field_(std::make_shared<const terrain::Heightfield>(std::move(field))),
      scene_(std::move(scene)),
      table_(table),
      method_(method_of(scene_, table)),
      diagonal_(diagonal_of(scene_, method_)),
      program_version_(std::move(program_version)) {
  scene_.terrain = field_->provenance.source;
  scene_.diagonal = name_of(diagonal_);
  if (!scene_.drape.empty())
    drape_ = std::make_unique<const image::ColourImage>(image::read_colour(scene_.drape));
  if (scene_.painter == audit::Painter::Method)
    scene_.choice = resolved_choice(*method_, std::move(scene_.choice));
}

SceneDrawer::~SceneDrawer() = default;

void SceneDrawer::prepare() {
  Stopwatch watch;
  auto painter = std::make_unique<Painter>();
  if (scene_.painter == audit::Painter::Truth && field_->stacks != nullptr) {
    painter->solid = std::make_unique<const MeshTruth>(
        *field_, full_detail_of_stacks(table_, *field_, method_, scene_.choice));
  } else if (scene_.painter == audit::Painter::Truth) {
    painter->caster = std::make_unique<const reference::PyramidCaster>(*field_, diagonal_);
  } else {
    painter->method = prepare_method(*method_, *field_, scene_.choice, scene_.tolerance);
    painter->run = painter->method->start();
  }
  painter_ = std::move(painter);
  prepare_s_ = watch.lap_s();
}

DrawnScene SceneDrawer::draw(const CameraDescription& camera, const StepListener& on_step) {
  const auto step = [&](const std::string& what) {
    if (on_step) on_step(what);
  };
  const bool by_rays = scene_.painter == audit::Painter::Truth;
  DrawnScene drawn;
  drawn.scene = scene_;
  drawn.field = field_;
  step("placing the camera");
  const PlacedCamera placed = place_camera(camera, *field_);
  drawn.camera = placed.camera;
  drawn.scene.camera = placed.description;
  require_frame_memory(drawn.camera, kPictureBytes);
  step(by_rays ? "casting rays" : "drawing the surface");
  if (!painter_) prepare();
  Stopwatch watch;
  Layers layers;
  if (by_rays) {
    drawn.hits = painter_->solid ? painter_->solid->caster().cast_frame(drawn.camera)
                                 : painter_->caster->cast_frame(drawn.camera);
  } else {
    drawn.surface = painter_->run->step(drawn.camera, scene_.tolerance);
    SurfacePicture picture = picture_of(drawn.surface, drawn.camera);
    drawn.hits = std::move(picture.image);
    layers = std::move(picture.layers);
    drawn.surface.cost.fragments = picture.fragments;
  }
  drawn.times.prepare_s = prepare_s_;
  drawn.times.draw_s = watch.lap_s();
  step("making the picture");
  PictureMaker maker = maker_of(drawn.scene, diagonal_, program_version_);
  maker.drape = drape_.get();
  if (!layers.empty()) maker.layers = &layers;
  drawn.picture = by_rays && !painter_->solid
                      ? draw_truth_picture(*field_, drawn.hits, drawn.camera, maker)
                      : draw_picture(*field_, drawn.hits,
                                     painter_->solid ? painter_->solid->surface() : drawn.surface,
                                     drawn.camera, maker);
  drawn.times.picture_s = watch.lap_s();
  return drawn;
}

DrawnScene draw_scene(const Scene& scene, const MethodTable& table,
                      const std::string& program_version, const StepListener& on_step) {
  method_of(scene, table);  // before the terrain is read
  Stopwatch watch;
  if (on_step) on_step("reading the terrain");
  terrain::Heightfield field = terrain::load_terrain(scene.terrain, scene.read);
  const double read_s = watch.lap_s();
  SceneDrawer drawer(std::move(field), scene, table, program_version);
  DrawnScene drawn = drawer.draw(scene.camera, on_step);
  drawn.times.read_s = read_s;
  return drawn;
}

}  // namespace plumb::audit
