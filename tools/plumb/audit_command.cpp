// plumb audit: how wrong a method's picture is, where, and whether it kept its promise.
#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>

#include "audit/audit.h"
#include "audit/audit_json.h"
#include "audit/audit_page.h"
#include "command.h"
#include "common_options.h"
#include "core/parallel.h"
#include "method_options.h"
#include "progress.h"
#include "terrain/mesh_file.h"
#include "terrain/terrain_source.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

using audit::AuditResult;
using Rows = std::vector<std::vector<std::string>>;

struct AuditCommandOptions {
  TerrainOptions terrain;
  CameraOptions camera;
  MethodOptions method;
  std::string mesh_file, mesh_origin, mesh_up = "z";
  std::vector<std::string> limits;
  std::string output;
  bool without_nearest = false;
  bool json = false;
  int threads = 0;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Rows claim_rows(const AuditResult& result) {
  Rows rows;
  for (const audit::ClaimResult& c : result.claims) {
    const auto tightness = c.tightness();
    rows.push_back({c.label,
                    c.claim.scope == Scope::Frame ? (c.is_limit ? "limit" : "frame")
                                                  : fmt::format("patch {}", c.claim.patch),
                    audit::with_unit(c.claim.bound, c.claim.unit),
                    audit::with_unit(c.measured, c.claim.unit),
                    tightness ? audit::short_number(*tightness) : "-", std::to_string(c.violations),
                    c.holds ? "held" : "BROKEN"});
  }
  return rows;
}

Rows error_rows(const AuditResult& result) {
  Rows rows;
  const auto add = [&](const char* name, const audit::Distribution& d) {
    rows.push_back({name, audit::short_number(d.max), audit::short_number(d.p99),
                    audit::short_number(d.rms), std::to_string(d.count)});
  };
  add("sample error, m", result.samples.metres);
  add("sample error in view, px", result.samples.pixels);
  add("pixel error, vertical, px", result.vertical);
  add("  from the truth, px", result.reverse_vertical);
  if (!result.nearest.forward_px.empty()) {
    add("pixel error, nearest, px", result.nearest.forward);
    add("  from the truth, px", result.nearest.reverse);
  }
  add("depth, relative", result.depth);
  add("normals, degrees", result.normal_deg);
  return rows;
}

std::string audit_text(const AuditResult& result) {
  std::string text = text_table({{"claim"},
                                 {"scope"},
                                 {"claimed", true},
                                 {"measured", true},
                                 {"tightness", true},
                                 {"violations", true},
                                 {"verdict"}},
                                claim_rows(result));
  text += "\n" +
          text_table({{"error"}, {"max", true}, {"p99", true}, {"RMS", true}, {"of", true}},
                     error_rows(result)) +
          "\n";
  const audit::Coverage& c = result.coverage;
  const audit::Topology& t = result.topology;
  const audit::AuditTimes& s = result.times;
  text += text_table(
      {{""}, {""}},
      {{"coverage", fmt::format("{} holes, {} overshoots, {} see-through pixels", c.holes,
                                c.overshoots, c.see_through)},
       {"samples", fmt::format("{} with nothing drawn over them, {} voids drawn over",
                               result.samples.uncovered, result.samples.over_void)},
       {"topology",
        fmt::format("{} open edges, {} T-junctions, {} non-manifold, {} degenerate, {} folded",
                    t.open_edges, t.t_junctions, t.non_manifold_edges + t.non_manifold_vertices,
                    t.degenerate_triangles, t.folded_triangles)},
       {"drawn",
        fmt::format("{} triangles, {} fragments", result.cost.triangles, result.cost.fragments)},
       {"patches", fmt::format("{} claims of their own judged, {} broken", result.patch_claims,
                               result.patch_claims_broken)},
       {"time",
        fmt::format("prepare {:.3f} s, draw {:.3f}, raster {:.3f}, truth {:.3f}, measures {:.3f}",
                    s.prepare_s, s.draw_s, s.raster_s, s.truth_s, s.measure_s)}});
  for (const audit::Offender& o : result.offenders) {
    if (result.holds() || o.x < 0) continue;
    text += fmt::format("worst: {} {} at pixel ({}, {}), world ({:.8g}, {:.8g}, {:.7g}){}\n",
                        o.what, audit::with_unit(o.value, o.unit), o.x, o.y, o.world_m.x,
                        o.world_m.y, o.world_m.z,
                        o.patch >= 0 ? fmt::format(", patch {} ({})", o.patch, o.patch_name) : "");
    break;
  }
  return text + "\n" + audit::verdict_sentence(result) + "\n";
}

// What is drawn, and how long it took: a method's surface, or a mesh from a file.
struct Subject {
  DrawnSurface surface;
  double prepare_s = 0.0, draw_s = 0.0;
};

Subject draw_method(const MethodRequest& request, const terrain::Heightfield& field,
                    const Camera& camera, Progress& progress) {
  Subject subject;
  progress.step("preparing the method");
  auto start = std::chrono::steady_clock::now();
  const auto prepared =
      audit::prepare_method(*request.method, field, request.choice, request.tolerance);
  subject.prepare_s = seconds_since(start);
  progress.step("drawing");
  start = std::chrono::steady_clock::now();
  subject.surface = prepared->draw(camera, request.tolerance);
  subject.draw_s = seconds_since(start);
  return subject;
}

Subject read_subject(const AuditCommandOptions& options, Progress& progress) {
  progress.step("reading the mesh");
  terrain::MeshReadOptions read;
  read.up_axis = options.mesh_up == "y" ? terrain::UpAxis::Y : terrain::UpAxis::Z;
  if (!options.mesh_origin.empty())
    read.origin_m = parse_point(options.mesh_origin, "--mesh-origin");
  auto mesh = std::make_shared<TriangleMesh>(terrain::read_mesh(options.mesh_file, read));
  Subject subject;
  subject.surface.cost.vertices = static_cast<std::int64_t>(mesh->vertices_m.size());
  subject.surface.cost.triangles = static_cast<std::int64_t>(mesh->triangles.size());
  subject.surface.mesh = std::move(mesh);
  subject.surface.notes.push_back(
      "A mesh from a file claims nothing but to have no hole; --limit has more judged. Its "
      "silhouettes may move by --tolerance; where they move farther, terrain seen past them counts "
      "as see-through.");
  return subject;
}

int run_audit(const AuditCommandOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  const MethodRequest request = method_request(options.method);
  audit::AuditOptions audit_options;
  for (const std::string& text : options.limits)
    audit_options.limits.push_back(audit::parse_limit(text));
  audit_options.nearest = !options.without_nearest;
  (request.tolerance.unit == Unit::Pixel ? audit_options.band.pixels : audit_options.band.metres) =
      request.tolerance.value;

  Progress progress;
  progress.step("reading the terrain");
  const terrain::Heightfield field = load(options.terrain);
  const Camera camera = make_camera(look_at(options.camera, field));
  const bool from_file = !options.mesh_file.empty();
  const Subject drawn =
      from_file ? read_subject(options, progress) : draw_method(request, field, camera, progress);
  const DrawnSurface& surface = drawn.surface;
  progress.step("casting the truth and measuring");
  const terrain::Diagonal diagonal = options.terrain.diagonal.empty()
                                         ? request.method->truth
                                         : terrain::parse_diagonal(options.terrain.diagonal);
  const audit::HeightfieldTruth truth(field, diagonal);
  AuditResult result = audit::audit_surface(truth, surface, camera, audit_options);
  result.times.prepare_s = drawn.prepare_s;
  result.times.draw_s = drawn.draw_s;

  audit::AuditSubject subject{&field,
                              diagonal,
                              request.method->name,
                              request.variant,
                              request.choice.parameters,
                              request.tolerance,
                              camera,
                              options.camera.camera,
                              invocation.command_line()};
  if (from_file) {
    subject.method = "mesh " + options.mesh_file;
    subject.variant.clear();
  }
  std::vector<std::string> files;
  if (!options.output.empty()) {
    progress.step("writing the report");
    files = audit::write_report(options.output, result, subject, surface, truth);
  }
  progress.finish();
  std::cout << (options.json ? audit::audit_json(result, subject) : audit_text(result));
  if (!options.json) {
    for (const std::string& note : surface.notes) std::cout << note << "\n";
  }
  if (!options.json && !files.empty()) {
    std::string list;
    for (const std::string& file : files) list += " " + file;
    std::cout << "written to " << options.output << ":" << list << "\n";
  }
  return result.holds() ? 0 : 1;
}

}  // namespace

Command audit_command() {
  Command command;
  command.name = "audit";
  command.summary =
      "Tell how wrong a method's picture is, where, and whether its claims hold (exit status 1 if "
      "not)";
  command.example =
      "plumb audit 'generate:alpine?size=513' --method restricted-quadtree --tolerance 1px "
      "--camera oblique -o report";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<AuditCommandOptions>();
    values->terrain.diagonal = "";
    add_terrain_options(options, values->terrain);
    add_method_options(options, values->method);
    add_camera_options(options, values->camera);
    options.group("A mesh in place of a method");
    options.text(values->mesh_file, "--mesh", "FILE",
                 "Audit the triangles of this PLY, OBJ, STL, glTF or GLB file");
    options.text(values->mesh_origin, "--mesh-origin", "X,Y,Z",
                 "Where its (0, 0, 0) lies in the terrain's coordinates, metres (0,0,0)");
    options.choice(values->mesh_up, "--mesh-up", {"z", "y"},
                   "Its upward axis (z); with y, its -z is north");
    options.group("Audit");
    options.texts(values->limits, "--limit", "MEASURE=VALUE",
                  "Judge this as well: " + limit_names());
    options.flag(values->without_nearest, "--without-nearest",
                 "Leave out the distances to nearest points, the slowest measure");
    options.group("Output");
    add_output_option(options, values->output,
                      "Write JSON, heat maps and a self-contained page into this folder");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_audit(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
