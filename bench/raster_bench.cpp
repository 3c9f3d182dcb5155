// Triangles a second of the rasteriser, depth and triangle of each pixel, beside Mesa's llvmpipe on
// the same mesh in the same run.
#include "bench_support.h"
#include "core/instruction_set.h"
#include "mesh/full/full_detail.h"
#include "raster/rasteriser.h"
#include "raster/vertex_stage.h"
#ifdef PLUMB_WITH_GL
#include "support/software_gl.h"
#endif

namespace plumb::bench {
namespace {

const DrawnSurface& full_surface() {
  static const auto surface = [] {
    const auto prepared = mesh::full::prepare(bench_terrain());
    return mesh::full::draw(prepared, Camera{}, Tolerance{});
  }();
  return surface;
}

const TriangleMesh& full_mesh() { return *full_surface().mesh; }

// Every triangle looked at, or those alone whose runs may be in view.
enum class Culling { None, Runs };

void our_frame(benchmark::State& state, const char* preset, InstructionSet set, Culling culling) {
  const Camera camera = bench_camera(preset);
  const ForcedInstructionSet forced(set);
  std::int64_t fragments = 0;
  full_mesh();  // is made before the first measurement
  const raster::RasterOptions options{
      .runs = culling == Culling::Runs ? full_surface().usable_runs() : nullptr};
  measure(state, [&] { fragments = raster::rasterise(full_mesh(), camera, options).fragments; });
  set_rate(state, "Mtriangles/s", static_cast<double>(full_mesh().triangles.size()));
  state.counters["fragments"] = static_cast<double>(fragments);
}

#ifdef PLUMB_WITH_GL
// The vertices as single precision in the window; those behind the eye go far outside.
void mesa_frame(benchmark::State& state, const char* preset) {
  const Camera camera = bench_camera(preset);
  std::string why_not;
  const auto gl = test_support::SoftwareGl::create(why_not);
  if (!gl) {
    state.SkipWithError(why_not.c_str());
    return;
  }
  const raster::Projection projection = raster::make_projection(camera, full_mesh().origin_m);
  std::vector<test_support::WindowCorner> corners;
  corners.reserve(full_mesh().vertices_m.size());
  for (const glm::dvec3& vertex : full_mesh().vertices_m) {
    const glm::dvec3 view = projection.view(projection.from_eye(vertex));
    const bool seen = projection.outcode(view) == 0;
    const glm::dvec2 px = seen ? view_to_pixel(camera, view) : glm::dvec2(-1e5);
    corners.push_back({static_cast<float>(px.x), static_cast<float>(px.y),
                       seen ? static_cast<float>(1.0 - camera.near_m / view.z) : 0.0f});
  }
  gl->load(corners, {full_mesh().triangles.front().data(), 3 * full_mesh().triangles.size()});
  measure(state, [&] {
    benchmark::DoNotOptimize(gl->draw(camera.width_px, camera.height_px, true).data());
  });
  set_rate(state, "Mtriangles/s", static_cast<double>(full_mesh().triangles.size()));
}
#endif

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  using namespace plumb::bench;
  for (const char* preset : kPresets) {
    const std::string view = std::string("/") + preset;
    for (const auto set : plumb::available_instruction_sets())
      add(std::string("raster/") + name_of(set) + view, our_frame, preset, set, Culling::None);
    add("raster/culled" + view, our_frame, preset, plumb::available_instruction_sets().back(),
        Culling::Runs);
#ifdef PLUMB_WITH_GL
    add("llvmpipe" + view, mesa_frame, preset);
#endif
  }
  return plumb::bench::run(argc, argv);
}
