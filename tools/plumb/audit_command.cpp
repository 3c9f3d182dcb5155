// plumb audit: how wrong a method's picture is, where, and whether it kept its promise.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "audit/audit.h"
#include "audit/audit_json.h"
#include "audit/audit_page.h"
#include "audit/frame_audit.h"
#include "audit/frame_memory.h"
#include "audit/method_truth.h"
#include "audit/verdict_text.h"
#include "audit_path.h"
#include "audit_text.h"
#include "audit_truth.h"
#include "command.h"
#include "common_options.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "method_options.h"
#include "progress.h"
#include "stranger.h"
#include "terrain/terrain_source.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

using audit::AuditResult;

struct AuditCommandOptions {
  TerrainOptions terrain;
  CameraOptions camera;
  MethodOptions method;
  StrangerOptions stranger;
  std::vector<std::string> limits;
  std::string output;
  bool without_nearest = false;
  bool json = false;
  int threads = 0;
};

// What is drawn, and how long it took: a method's surface, or a stranger's.
struct Subject : Stranger {
  double prepare_s = 0.0, draw_s = 0.0;
};

audit::AuditOptions audit_options(const AuditCommandOptions& options,
                                  const MethodRequest& request) {
  audit::AuditOptions result;
  for (const std::string& text : options.limits) result.limits.push_back(audit::parse_limit(text));
  result.nearest = !options.without_nearest;
  result.band = audit::band_of(*request.method, request.variant, request.tolerance);
  return result;
}

// What all frames of a run share.
struct Run {
  const AuditCommandOptions& options;
  const Invocation& invocation;
  const MethodRequest request;
  const audit::AuditOptions measures;
  const terrain::Heightfield& field;
  const terrain::Diagonal diagonal;  // of the truth, where it is a heightfield
  const audit::TruthTerms truth;
  Progress& progress;
  std::unique_ptr<audit::PreparedMethod> prepared;  // null for a stranger's output
  std::unique_ptr<audit::MethodRun> frames;         // of it
  Subject drawn;                                    // with a stranger's mesh
};

void prepare(Run& run, const Camera& first) {
  const StrangerOptions& stranger = run.options.stranger;
  if (stranger.is_mesh()) {
    run.progress.step("reading the mesh");
    static_cast<Stranger&>(run.drawn) =
        read_stranger_mesh(stranger, run.truth, first, run.request.tolerance);
    run.progress.finish();
    for (const std::string& line : run.drawn.warnings) warn(line);
  }
  if (stranger.is_given()) return;
  run.progress.step("preparing the method");
  Stopwatch watch;
  run.prepared = audit::prepare_method(*run.request.method, run.field, run.request.choice,
                                       run.request.tolerance);
  run.frames = run.prepared->start();
  run.drawn.prepare_s = watch.lap_s();
}

struct Audited {
  AuditResult result;
  audit::AuditSubject subject;
  std::vector<std::string> files;
};

// The truth is cast first, and what does not fit it is not audited.
AuditResult audit_depth(Run& run, const Camera& camera) {
  Stopwatch watch;
  const audit::HeightfieldTruth& truth = *run.truth.heights();
  DepthFrame frame = read_depth_frame(run.options.stranger, truth, camera, run.measures.band,
                                      run.request.tolerance);
  static_cast<Stranger&>(run.drawn) = std::move(frame.stranger);
  if (!run.drawn.warnings.empty()) run.progress.finish();
  for (const std::string& line : run.drawn.warnings) warn(line);
  const double truth_s = watch.lap_s();
  AuditResult result = audit::audit_picture(truth, std::move(frame.true_hits), run.drawn.surface,
                                            std::move(frame.drawn), camera, run.measures);
  result.times.truth_s = truth_s;
  return result;
}

Audited audit_frame(Run& run, const Camera& camera, const std::string& frame) {
  const std::string where = frame.empty() ? "" : frame + ": ";
  if (run.prepared) {
    run.progress.step(where + "drawing");
    Stopwatch watch;
    run.drawn.surface = run.frames->step(camera, run.request.tolerance);
    run.drawn.draw_s = watch.lap_s();
  }
  run.progress.step(where + "casting the truth and measuring");
  const bool is_depth = run.options.stranger.is_depth();
  Audited audited{is_depth ? audit_depth(run, camera)
                           : audit::audit_frame(run.truth, run.drawn.surface, camera, run.measures),
                  {&run.field, run.diagonal, run.request.method->name, run.request.variant,
                   run.request.choice.parameters, run.request.tolerance, camera,
                   run.options.camera.camera, run.invocation.command_line(), run.drawn.assumptions,
                   run.drawn.hints, run.drawn.surface.notes},
                  {}};
  audited.result.times.prepare_s = run.drawn.prepare_s;
  audited.result.times.draw_s = run.drawn.draw_s;
  if (run.options.stranger.is_given()) {
    audited.subject.method = run.options.stranger.name();
    audited.subject.variant.clear();
    audited.subject.parameters = {run.drawn.parameters.begin(), run.drawn.parameters.end()};
  }
  return audited;
}

void write_frame(const Run& run, Audited& audited, const std::string& folder) {
  if (run.options.output.empty()) return;
  run.progress.step("writing the report");
  audited.files =
      audit::write_report(folder, audited.result, audited.subject, run.drawn.surface, run.truth);
}

int exit_status(audit::Verdict verdict) {
  return verdict == audit::Verdict::Held ? 0 : verdict == audit::Verdict::Broken ? 1 : 2;
}

int audit_one(Run& run, const Camera& camera) {
  Audited audited = audit_frame(run, camera, "");
  write_frame(run, audited, run.options.output);
  run.progress.finish();
  const bool json = run.options.json;
  std::cout << (json ? audit::audit_json(audited.result, audited.subject)
                     : audit_text(audited.result));
  if (!json) {
    for (const std::string& note : run.drawn.surface.notes) std::cout << note << "\n";
    for (const std::string& line : run.drawn.assumptions) std::cout << "assumed: " << line << "\n";
  }
  if (!json && !audited.files.empty()) {
    std::string list;
    for (const std::string& file : audited.files) list += " " + file;
    std::cout << "written to " << run.options.output << ":" << list << "\n";
  }
  const audit::Verdict verdict = audited.result.verdict();
  if (json && verdict == audit::Verdict::None)
    std::cerr << audit::verdict_sentence(audited.result) << "\n";
  return exit_status(verdict);
}

int audit_path(Run& run, const std::vector<Camera>& frames,
               const std::vector<audit::Limit>& popping_limits) {
  const std::string& output = run.options.output;
  PathReport path(run.truth, popping_limits, run.measures.band);
  for (std::size_t k = 1; k <= frames.size(); ++k) {
    const Camera& camera = frames[k - 1];
    Audited audited = audit_frame(run, camera, fmt::format("frame {} of {}", k, frames.size()));
    audited.subject.command += fmt::format(" --frame {}", k);
    path.measure(audited.result, run.drawn.surface, camera);
    write_frame(run, audited, output + "/" + frame_name(k));
    path.add(audited.result, audited.subject, run.options.json || !output.empty());
  }
  std::vector<std::string> files;
  if (!output.empty()) files = path.write(output, run.invocation.command_line());
  run.progress.finish();
  if (run.options.json) {
    std::cout << path.json();
  } else {
    std::cout << path.text();
    std::string list;
    for (const std::string& file : files) list += " " + file;
    if (!files.empty())
      std::cout << "written to " << output << ":" << list << ", " << frame_name(1) << " and on\n";
  }
  const audit::Verdict verdict = path.count().verdict();
  if (run.options.json && verdict == audit::Verdict::None) std::cerr << path.count().text() << "\n";
  return exit_status(verdict);
}

int run_audit(const AuditCommandOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  if (options.output == "-")
    input_error("-o -: audit writes several files, expected a folder (--json prints one object)");
  require_consistent(options.stranger, invocation.arguments);
  const MethodRequest request = method_request(options.method);
  audit::AuditOptions measures = audit_options(options, request);
  const std::vector<audit::CameraDescription> described = camera_frames(options.camera);
  const std::vector<audit::Limit> popping_limits =
      take_popping_limits(measures.limits, described.size());
  if (options.stranger.is_depth() && described.size() > 1)
    input_error(
        "--depth: a depth buffer is one frame, '{}' has {} cameras (choose one with --frame)",
        options.camera.camera, described.size());
  Progress progress;
  progress.step("reading the terrain");
  const terrain::Heightfield field = load(options.terrain);
  std::vector<Camera> frames;  // a camera that is none is known before anything is drawn
  for (const audit::CameraDescription& frame : described) {
    frames.push_back(audit::place_camera(frame, field).camera);
    audit::require_frame_memory(frames.back(), options.stranger.is_depth() ? audit::kDepthAuditBytes
                                               : described.size() > 1      ? audit::kPathAuditBytes
                                                                           : audit::kAuditBytes);
  }
  const terrain::Diagonal diagonal = options.terrain.diagonal.empty()
                                         ? request.method->truth
                                         : terrain::parse_diagonal(options.terrain.diagonal);
  require_fitting(options.terrain, options.stranger, request, field);
  if (field.stacks != nullptr) progress.step("making the truth");
  const audit::MethodTruth truth(field, diagonal, audit::built_in_methods(), request.method,
                                 request.choice);
  Run run{options,       invocation, request, measures, field, diagonal,
          truth.terms(), progress,   nullptr, nullptr,  {}};
  prepare(run, frames.front());
  for (std::string& line : assumptions(run.truth, request, options.stranger.is_given()))
    run.drawn.assumptions.push_back(std::move(line));
  return frames.size() == 1 ? audit_one(run, frames.front())
                            : audit_path(run, frames, popping_limits);
}

}  // namespace

Command audit_command() {
  Command command;
  command.name = "audit";
  command.summary =
      "Tell how wrong a method's picture is, where, and whether its claims hold (exit status 1 if "
      "not, 2 if nothing could be measured)";
  command.example =
      "plumb audit 'generate:alpine?size=513' --method restricted-quadtree --tolerance 1px "
      "--camera oblique -o report\n"
      "  plumb render 'generate:alpine?size=513' --size 640x360 -o depth.exr && plumb audit "
      "'generate:alpine?size=513' --size 640x360 --depth depth.exr --tolerance 1px";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<AuditCommandOptions>();
    values->terrain.diagonal = "";
    add_terrain_options(options, values->terrain);
    add_method_options(options, values->method);
    add_camera_options(options, values->camera);
    add_stranger_options(options, values->stranger);
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
