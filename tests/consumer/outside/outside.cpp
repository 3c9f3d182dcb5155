// A program outside the tree: brings a method of its own, and has it audited beside those that come
// with the library.
#include <audit/audit.h>
#include <audit/method.h>
#include <terrain/camera_presets.h>
#include <terrain/terrain_source.h>

#include <cstdio>
#include <memory>

namespace {

using plumb::terrain::Heightfield;

struct Coarse {
  const Heightfield* field;
  int stride;
};

// Every n-th sample in a grid of two triangles a cell: it has no idea of its error, and claims what
// it was asked for.
Coarse prepare(const Heightfield& field) { return {&field, 8}; }

plumb::DrawnSurface draw(const Coarse& coarse, const plumb::Camera&,
                         const plumb::Tolerance& tolerance) {
  const Heightfield& field = *coarse.field;
  const int columns = field.cell_columns() / coarse.stride + 1,
            rows = field.cell_rows() / coarse.stride + 1;
  auto mesh = std::make_shared<plumb::TriangleMesh>();
  mesh->origin_m = field.world_origin_m();
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = i * coarse.stride, b = j * coarse.stride;
      mesh->vertices_m.emplace_back(a * field.dx_m, b * field.dy_m, field.heights_m(a, b));
    }
  }
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const auto sw = static_cast<std::uint32_t>(j * columns + i),
                 nw = sw + static_cast<std::uint32_t>(columns);
      mesh->triangles.push_back({sw, sw + 1, nw + 1});
      mesh->triangles.push_back({sw, nw + 1, nw});
    }
  }
  plumb::DrawnSurface surface;
  surface.mesh = std::move(mesh);
  surface.claims = {{plumb::Measure::SampleError, tolerance.value, tolerance.unit}};
  return surface;
}

bool audit(const plumb::audit::MethodTable& table, const char* name, const Heightfield& field,
           const plumb::Camera& camera) {
  const plumb::audit::Method& method = plumb::audit::find_method(table, name);
  const plumb::Tolerance tolerance{5.0, plumb::Unit::Metre};
  const auto prepared = plumb::audit::prepare_method(method, field, {}, tolerance);
  const plumb::audit::HeightfieldTruth truth(field, method.truth);
  const plumb::audit::AuditResult result =
      plumb::audit::audit_surface(truth, prepared->draw(camera, tolerance), camera);
  std::printf("%s: claimed 5 m, measured %.3f m, %s\n", name, result.samples.worst_m.error,
              result.holds() ? "held" : "broken");
  return result.holds();
}

}  // namespace

int main() {
  const Heightfield field = plumb::terrain::load_terrain("generate:alpine?size=65&seed=7");
  const plumb::Camera camera =
      plumb::make_camera(plumb::terrain::preset_camera(field, "oblique", 320, 180, 50.0));

  plumb::audit::MethodTable table = plumb::audit::built_in_methods();
  plumb::audit::Method coarse;
  coarse.name = "every-eighth";
  coarse.summary = "every eighth sample, whatever the error";
  coarse.variants = {"published"};
  coarse.tolerance_units = {plumb::Unit::Metre};
  coarse.prepare = [](const Heightfield& terrain, const plumb::audit::MethodChoice&) {
    return plumb::audit::adapt(prepare(terrain), draw);
  };
  table.push_back(coarse);

  const bool ours_holds = audit(table, "every-eighth", field, camera);
  const bool theirs_holds = audit(table, "restricted-quadtree", field, camera);
  return !ours_holds && theirs_holds ? 0 : 1;  // the audit must tell them apart
}
