// A scene as TOML: the way back of scene.cpp.
#include <fmt/format.h>

#include "audit/scene.h"
#include "audit/toml_document.h"

namespace plumb::audit {
namespace {

class Writer {
 public:
  void table(const char* name) {
    text_ += fmt::format("{}[{}]\n", text_.empty() ? "" : "\n", name);
  }
  void raw(const std::string& key, const std::string& value) {
    text_ += fmt::format("{} = {}\n", key, value);
  }
  void text(const std::string& key, const std::string& value) {
    if (!value.empty()) raw(key, toml_text(value));
  }
  void number(const std::string& key, const std::optional<double>& value) {
    if (value) raw(key, toml_number(*value));
  }
  void whole(const std::string& key, const std::optional<int>& value) {
    if (value) raw(key, fmt::format("{}", *value));
  }
  void vector(const std::string& key, const std::optional<glm::dvec3>& v) {
    if (v)
      raw(key,
          fmt::format("[{}, {}, {}]", toml_number(v->x), toml_number(v->y), toml_number(v->z)));
  }
  void matrix(const std::string& key, const std::array<double, 16>& numbers) {
    std::string list;
    for (const double number : numbers) list += (list.empty() ? "" : ", ") + toml_number(number);
    raw(key, "[" + list + "]");
  }
  std::string result() const { return text_; }

 private:
  std::string text_;
};

void write_terrain(Writer& to, const Scene& scene) {
  const terrain::ReadOptions& read = scene.read;
  const terrain::ReadOptions usual;
  to.table("terrain");
  to.text("source", scene.terrain);
  if (read.window) {
    const terrain::Window& w = *read.window;
    to.raw("window", fmt::format("[{}, {}, {}, {}]", w.x, w.y, w.width, w.height));
  }
  if (read.spacing_x_m) {
    const double y_m = read.spacing_y_m.value_or(*read.spacing_x_m);
    to.raw("spacing", fmt::format("[{}, {}]", toml_number(*read.spacing_x_m), toml_number(y_m)));
  }
  if (read.band != usual.band) to.whole("band", read.band);
  if (read.decode != usual.decode) to.text("decode", name_of(read.decode));
  if (read.height_scale != usual.height_scale) to.number("height_scale", read.height_scale);
  if (read.height_offset_m != usual.height_offset_m)
    to.number("height_offset", read.height_offset_m);
  to.number("nodata", read.no_data);
  if (read.top_surface) to.text("surface", "top");
  if (read.no_data_policy != usual.no_data_policy) to.text("no_data", name_of(read.no_data_policy));
  to.text("crs", read.crs);
  if (read.raw_size)
    to.text("raw", fmt::format("{}x{}", read.raw_size->columns, read.raw_size->rows));
  if (read.origin)
    to.raw("origin", fmt::format("[{}, {}]", toml_number(read.origin->longitude_deg),
                                 toml_number(read.origin->latitude_deg)));
  if (read.byte_order != usual.byte_order) to.text("byte_order", name_of(read.byte_order));
  to.text("diagonal", scene.diagonal);
}

void write_engine(Writer& to, const EngineCamera& engine) {
  const EngineCamera usual;
  to.matrix("view", engine.view);
  to.matrix("projection", engine.projection);
  to.text("layout", engine.layout == MatrixLayout::RowMajor ? "row-major" : "column-major");
  to.text("vectors", engine.vectors == VectorKind::Row ? "row" : "column");
  to.text("clip", engine.clip == ClipSpace::OpenGl     ? "opengl"
                  : engine.clip == ClipSpace::Direct3d ? "d3d"
                                                       : "vulkan");
  if (engine.reverse_z) to.raw("reverse_z", "true");
  to.text("world_axes", to_text(engine.world_axes));
  if (engine.metres_per_unit != usual.metres_per_unit)
    to.number("metres_per_unit", engine.metres_per_unit);
  if (engine.world_origin_m != usual.world_origin_m) to.vector("origin", engine.world_origin_m);
}

void write_camera(Writer& to, const CameraDescription& camera) {
  to.text("preset", camera.preset);
  to.whole("frame", camera.frame);
  to.whole("frames", camera.frames);
  to.vector("eye", camera.eye_m);
  to.vector("target", camera.target_m);
  to.vector("up", camera.up);
  to.number("fov_y_deg", camera.fov_y_deg);
  to.whole("width", camera.width_px);
  to.whole("height", camera.height_px);
  to.number("near", camera.near_m);
  to.number("far", camera.far_m);
  to.number("tilt_deg", camera.tilt_deg);
  if (camera.engine) write_engine(to, *camera.engine);
}

void write_method(Writer& to, const Scene& scene) {
  if (scene.method.empty()) return;
  to.table("method");
  to.text("name", scene.method);
  to.text("variant", scene.choice.variant);
  to.text("tolerance", to_text(scene.tolerance));
  if (scene.choice.parameters.empty()) return;
  to.table("method.parameters");
  for (const auto& [name, value] : scene.choice.parameters)
    to.raw(toml_text(name), toml_text(value));
}

}  // namespace

std::string to_toml(const Scene& scene) {
  Writer to;
  write_terrain(to, scene);
  to.table("camera");
  write_camera(to, scene.camera);
  write_method(to, scene);
  const bool by_rays = scene.painter == Painter::Truth;
  if (by_rays || !scene.drape.empty()) to.table("render");
  if (by_rays) to.text("what", "truth");
  to.text("drape", scene.drape);
  return to.result();
}

std::string inline_toml(const CameraDescription& camera) {
  Writer to;
  write_camera(to, camera);
  std::string line;
  for (const char c : to.result()) line += c == '\n' ? std::string(", ") : std::string(1, c);
  if (line.ends_with(", ")) line.resize(line.size() - 2);
  return "{ " + line + " }";
}

CameraDescription description_of(const LookAt& camera) {
  CameraDescription description;
  description.eye_m = camera.eye_m;
  description.target_m = camera.target_m;
  description.up = camera.up;
  description.fov_y_deg = camera.fov_y_deg;
  description.width_px = camera.width_px;
  description.height_px = camera.height_px;
  description.near_m = camera.near_m;
  description.far_m = camera.far_m;
  return description;
}

}  // namespace plumb::audit
