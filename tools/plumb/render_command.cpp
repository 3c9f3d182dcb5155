// plumb render: a terrain as a method draws it.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "audit/audit_page.h"
#include "audit/picture.h"
#include "audit/ply_file.h"
#include "audit/scene_picture.h"
#include "command.h"
#include "common_options.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "core/parallel.h"
#include "image/image_files.h"
#include "method_options.h"
#include "progress.h"
#include "terrain/terrain_source.h"
#include "text_table.h"
#include "version.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  TerrainOptions terrain;
  MethodOptions method;
  CameraOptions camera;
  std::string output, mesh, drape;
  bool json = false;
  int threads = 0;
};

// A scene file stands for everything that the other options would say.
audit::Scene scene_from_file(const RenderOptions& options) {
  TerrainOptions nothing_else;
  nothing_else.terrain = options.terrain.terrain;
  if (!(options.terrain == nothing_else && options.method == MethodOptions{} &&
        options.camera == CameraOptions{} && options.drape.empty())) {
    input_error(
        "{}: a scene says terrain, method, camera and drape itself: leave their options out",
        options.terrain.terrain);
  }
  return audit::read_scene_file(options.terrain.terrain);
}

audit::Scene scene_of(const RenderOptions& options) {
  if (options.terrain.terrain.ends_with(".toml")) return scene_from_file(options);
  const MethodRequest request = method_request(options.method);
  audit::Scene scene;
  scene.terrain = options.terrain.terrain;
  scene.read = read_options(options.terrain);
  scene.camera = camera_frames(options.camera).front();
  scene.method = request.method->name;
  scene.choice = request.choice;
  scene.tolerance = request.tolerance;
  scene.drape = options.drape;
  return scene;
}

enum class Target { Exr, Png, StandardOutput, Folder };

Target target_of(const RenderOptions& options) {
  if (options.output.empty()) input_error("render needs -o: a file (.exr or .png) or a folder");
  if (options.output == "-") {
    if (options.json) input_error("-o - and --json cannot both have the standard output");
    return Target::StandardOutput;
  }
  const fs::path path(options.output);
  if (fs::is_directory(path)) return Target::Folder;
  if (path.extension() == ".exr") return Target::Exr;
  if (path.extension() == ".png") return Target::Png;
  if (path.has_extension())
    input_error("-o '{}': expected a name that ends in .exr or .png, or a folder", options.output);
  return Target::Folder;
}

// Returns the names of the files.
std::vector<std::string> write_files(const RenderOptions& options, Target target,
                                     const audit::DrawnScene& drawn) {
  if (!options.mesh.empty() && drawn.surface.mesh == nullptr)
    input_error("--mesh '{}': {} draws no mesh", options.mesh, drawn.scene.method);
  std::vector<std::string> files;
  const auto written = [&](const fs::path& path) { return files.emplace_back(path.string()); };
  const fs::path output(options.output);
  if (target == Target::StandardOutput) std::cout << image::exr_bytes(drawn.picture);
  if (target == Target::Exr) image::write_exr(written(output), drawn.picture);
  if (target == Target::Png) image::write_png(written(output), audit::preview_of(drawn.picture));
  if (target == Target::Folder) {
    make_folder(output);
    image::write_exr(written(output / "picture.exr"), drawn.picture);
    image::write_png(written(output / "picture.png"), audit::preview_of(drawn.picture));
    write_file_atomically(written(output / "scene.toml"), audit::to_toml(drawn.scene));
  }
  if (!options.mesh.empty()) audit::write_ply(written(options.mesh), drawn.surface);
  return files;
}

std::int64_t pixels_with_terrain(const HitImage& hits) {
  std::int64_t count = 0;
  for (std::size_t k = 0; k < hits.size(); ++k) count += hits.hit(k) ? 1 : 0;
  return count;
}

std::string checksum_text(const audit::DrawnScene& drawn) {
  return fmt::format("{:016x}", image::raw_checksum(drawn.picture));
}

std::string drawn_by(const audit::Scene& scene) {
  if (scene.painter == audit::Painter::Truth) return "truth";
  return fmt::format("{}, {}, {}", scene.method, scene.choice.variant, to_text(scene.tolerance));
}

std::string render_text(const audit::DrawnScene& drawn, const std::vector<std::string>& files) {
  const Cost& cost = drawn.surface.cost;
  std::vector<std::vector<std::string>> rows{
      {"terrain", drawn.scene.terrain},
      {"drawn by", drawn_by(drawn.scene)},
      {"picture", fmt::format("{} x {} pixels, {} show terrain", drawn.picture.width_px,
                              drawn.picture.height_px, pixels_with_terrain(drawn.hits))},
      {"checksum", checksum_text(drawn)}};
  if (drawn.surface.mesh != nullptr) {
    rows.push_back({"mesh", fmt::format("{} vertices, {} triangles, {} fragments", cost.vertices,
                                        cost.triangles, cost.fragments)});
  } else if (drawn.surface.painter) {
    rows.push_back({"drawn", audit::drawn_text(cost)});
  }
  for (const std::string& note : drawn.surface.notes) rows.push_back({"note", note});
  for (const std::string& file : files) rows.push_back({"written", file});
  const audit::SceneTimes& t = drawn.times;
  rows.push_back({"time", fmt::format("read {:.3f} s, prepare {:.3f}, draw {:.3f}, picture {:.3f}",
                                      t.read_s, t.prepare_s, t.draw_s, t.picture_s)});
  return text_table({{""}, {""}}, rows);
}

std::string render_json(const audit::DrawnScene& drawn, const std::vector<std::string>& files,
                        const Invocation& invocation) {
  const audit::Scene& scene = drawn.scene;
  const Cost& cost = drawn.surface.cost;
  nlohmann::ordered_json json{{"schema", "plumb.render/1"}, {"command", invocation.command_line()}};
  json["terrain"] = {{"source", scene.terrain},
                     {"checksum", fmt::format("{:016x}", terrain::checksum(*drawn.field))},
                     {"columns", drawn.field->columns()},
                     {"rows", drawn.field->rows()},
                     {"assumptions", drawn.field->provenance.assumptions}};
  json["what"] = scene.painter == audit::Painter::Truth ? "truth" : "method";
  if (scene.painter == audit::Painter::Method) {
    json["method"] = {{"name", scene.method},
                      {"variant", scene.choice.variant},
                      {"parameters", scene.choice.parameters},
                      {"tolerance", to_text(scene.tolerance)},
                      {"notes", drawn.surface.notes}};
  }
  json["scene"] = audit::to_toml(scene);
  json["picture"] = {{"width_px", drawn.picture.width_px},
                     {"height_px", drawn.picture.height_px},
                     {"checksum", checksum_text(drawn)}};
  json["counters"] = {{"pixels_with_terrain", pixels_with_terrain(drawn.hits)},
                      {"vertices", cost.vertices},
                      {"triangles", cost.triangles},
                      {"slices", cost.slices},
                      {"fragments", cost.fragments},
                      {"nodes_visited", cost.nodes_visited},
                      {"bytes_resident", cost.bytes_resident},
                      {"bytes_encoded", cost.bytes_encoded}};
  json["files"] = files;
  json["timing"] = {{"read_s", drawn.times.read_s},
                    {"prepare_s", drawn.times.prepare_s},
                    {"draw_s", drawn.times.draw_s},
                    {"picture_s", drawn.times.picture_s}};
  return json.dump(2) + "\n";
}

// A path: every frame by its number, in a folder.
int render_path(const RenderOptions& options, const audit::Scene& scene,
                const std::vector<audit::CameraDescription>& frames, Target target,
                const Invocation& invocation) {
  if (target != Target::Folder || !options.mesh.empty())
    input_error(
        "'{}' is a path of {} cameras: -o must be a folder, and there is no --mesh (or "
        "choose one with --frame)",
        options.camera.camera, frames.size());
  Progress progress;
  progress.step("reading the terrain");
  terrain::Heightfield field = terrain::load_terrain(scene.terrain, scene.read);
  std::vector<audit::CameraDescription> placed;  // one that is none is known before all the work
  for (const audit::CameraDescription& frame : frames)
    placed.push_back(audit::place_camera(frame, field).description);
  const fs::path folder(options.output);
  make_folder(folder);
  nlohmann::ordered_json json{{"schema", "plumb.render-path/1"},
                              {"command", invocation.command_line()}};
  std::vector<std::vector<std::string>> rows;
  audit::SceneDrawer drawer(std::move(field), scene, audit::built_in_methods(), version_number());
  for (std::size_t k = 1; k <= placed.size(); ++k) {
    progress.step(fmt::format("frame {} of {}", k, placed.size()));
    const audit::DrawnScene drawn = drawer.draw(placed[k - 1]);
    const std::string name = frame_name(k);
    image::write_exr((folder / (name + ".exr")).string(), drawn.picture);
    image::write_png((folder / (name + ".png")).string(), audit::preview_of(drawn.picture));
    rows.push_back({name, std::to_string(pixels_with_terrain(drawn.hits)),
                    std::to_string(drawn.surface.cost.triangles), checksum_text(drawn),
                    fmt::format("{:.3f}", drawn.times.draw_s)});
    json["frames"].push_back({{"name", name},
                              {"checksum", checksum_text(drawn)},
                              {"triangles", drawn.surface.cost.triangles},
                              {"scene", audit::to_toml(drawn.scene)}});
  }
  progress.finish();
  if (options.json) {
    std::cout << json.dump(2) << "\n";
  } else {
    std::cout << text_table({{"frame"},
                             {"pixels of terrain", true},
                             {"triangles", true},
                             {"checksum"},
                             {"s", true}},
                            rows)
              << "written to " << options.output << "\n";
  }
  return 0;
}

int run_render(const RenderOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  const Target target = target_of(options);
  const audit::Scene scene = scene_of(options);
  if (!options.mesh.empty() && scene.painter == audit::Painter::Truth)
    input_error("--mesh '{}': rays draw no mesh; --method full has the full-detail one",
                options.mesh);
  if (!options.terrain.terrain.ends_with(".toml")) {
    const std::vector<audit::CameraDescription> frames = camera_frames(options.camera);
    if (frames.size() > 1) return render_path(options, scene, frames, target, invocation);
  }
  Progress progress;
  const audit::DrawnScene drawn =
      audit::draw_scene(scene, audit::built_in_methods(), version_number(),
                        [&](const std::string& step) { progress.step(step); });
  progress.step("writing");
  const std::vector<std::string> files = write_files(options, target, drawn);
  progress.finish();
  if (target == Target::StandardOutput) return 0;
  std::cout << (options.json ? render_json(drawn, files, invocation) : render_text(drawn, files));
  return 0;
}

}  // namespace

Command render_command() {
  Command command;
  command.name = "render";
  command.summary =
      "Draw a terrain by a method, with depth, normals, patches and levels; TERRAIN "
      "may be a scene (.toml)";
  command.example =
      "plumb render 'generate:alpine?size=513' --method restricted-quadtree --tolerance 1px "
      "--camera oblique --size 640x360 -o picture.exr --mesh drawn.ply";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<RenderOptions>();
    add_terrain_options(options, values->terrain, false);
    add_method_options(options, values->method);
    add_camera_options(options, values->camera);
    add_drape_option(options, values->drape);
    options.group("Output");
    add_output_option(options, values->output,
                      ".exr with every channel, .png as a preview, - for the EXR on standard "
                      "output, or a folder for both and the scene");
    options.text(values->mesh, "--mesh", "PLY", "Also write the mesh that was drawn");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_render(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
