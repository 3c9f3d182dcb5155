// plumb truth: rays against the full-detail surface, by one caster or by two that must agree.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "audit/caster_agreement.h"
#include "audit/frame_memory.h"
#include "audit/method.h"
#include "audit/picture.h"
#include "audit/scene.h"
#include "command.h"
#include "common_options.h"
#include "core/check.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "image/image_files.h"
#include "progress.h"
#include "reference/embree_caster.h"
#include "reference/pyramid_caster.h"
#include "terrain/terrain_source.h"
#include "text_table.h"
#include "version.h"

namespace plumb::tool {
namespace {

struct TruthOptions {
  TerrainOptions terrain;
  CameraOptions camera;
  std::string caster;  // empty: "pyramid", of stacks "embree"
  std::string output, drape;
  bool witness = false;
  bool json = false;
  int threads = 0;
};

struct Cast {
  HitImage hits;
  double build_s = 0.0, cast_s = 0.0;
};

template <class MakeCaster>
Cast cast_with(const MakeCaster& make_caster, const Camera& camera) {
  Cast cast;
  Stopwatch watch;
  const auto caster = make_caster();
  cast.build_s = watch.lap_s();
  cast.hits = caster.cast_frame(camera);
  cast.cast_s = watch.lap_s();
  return cast;
}

Cast cast(const std::string& caster, const terrain::Heightfield& field, terrain::Diagonal diagonal,
          const Camera& camera) {
  if (caster == "embree") {
    return cast_with([&] { return reference::EmbreeCaster(field, diagonal, {.seen_by = camera}); },
                     camera);
  }
  return cast_with([&] { return reference::PyramidCaster(field, diagonal); }, camera);
}

// What draws the picture again, for its header.
audit::Scene scene_of(const TruthOptions& options, const terrain::Heightfield& field,
                      const audit::PlacedCamera& view) {
  audit::Scene scene;
  scene.terrain = field.provenance.source;
  scene.read = read_options(options.terrain);
  scene.diagonal = options.terrain.diagonal;
  scene.camera = view.description;
  scene.painter = audit::Painter::Truth;
  scene.drape = options.drape;
  return scene;
}

enum class Target { None, Exr, Png, StandardOutput };

Target target_of(const TruthOptions& options) {
  if (options.output.empty()) return Target::None;
  if (options.output == "-") {
    if (options.json) input_error("-o - and --json cannot both have the standard output");
    return Target::StandardOutput;
  }
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension == ".exr") return Target::Exr;
  if (extension == ".png") return Target::Png;
  input_error(
      "-o '{}': expected a name that ends in .exr (all channels) or .png (a preview), or - for the "
      "EXR on standard output",
      options.output);
}

// `mesh` is null where the truth is a heightfield; `drape` may be null.
void write_picture(const TruthOptions& options, Target target, const terrain::Heightfield& field,
                   const DrawnSurface* mesh, const HitImage& hits, const audit::PlacedCamera& view,
                   const image::ColourImage* drape) {
  audit::PictureMaker maker;
  maker.method = "truth";
  maker.diagonal = terrain::parse_diagonal(options.terrain.diagonal);
  maker.program_version = version_number();
  maker.scene_toml = audit::to_toml(scene_of(options, field, view));
  maker.drape = drape;
  const image::AovImage picture = mesh != nullptr
                                      ? audit::draw_picture(field, hits, *mesh, view.camera, maker)
                                      : audit::draw_truth_picture(field, hits, view.camera, maker);
  if (target == Target::Exr) image::write_exr(options.output, picture);
  if (target == Target::Png) image::write_png(options.output, audit::preview_of(picture));
  if (target == Target::StandardOutput) std::cout << image::exr_bytes(picture);
}

std::uint64_t checksum(const HitImage& hits) {
  return Checksum()
      .add(std::span<const double>(hits.depth_m))
      .add(std::span<const std::uint32_t>(hits.primitive))
      .value();
}

std::string truth_text(const TruthOptions& options, const Cast& cast, std::int64_t hits,
                       const audit::CasterAgreement* agreement) {
  std::vector<std::vector<std::string>> rows{
      {"caster", options.caster},
      {"rays", fmt::format("{}, of which {} hit", cast.hits.size(), hits)},
      {"checksum", fmt::format("{:016x}", checksum(cast.hits))},
      {"time", fmt::format("build {:.3f} s, cast {:.3f} s", cast.build_s, cast.cast_s)}};
  if (agreement != nullptr) {
    rows.push_back({"witness", fmt::format("{}: {} pixels hit by one alone, {} farther than 0.001 "
                                           "px apart, at most {:.3g} px; {} ties named "
                                           "another triangle",
                                           agreement->agrees() ? "agrees" : "DISAGREES",
                                           agreement->one_misses, agreement->apart,
                                           agreement->largest_px, agreement->other_triangle)});
    for (const audit::Disagreement& d : agreement->listed)
      rows.push_back({"", fmt::format("pixel ({}, {}): {} px", d.x, d.y, d.apart_px)});
  }
  return text_table({{""}, {""}}, rows);
}

std::string truth_json(const TruthOptions& options, const Invocation& invocation, const Cast& cast,
                       std::int64_t hits, const audit::CasterAgreement* agreement) {
  nlohmann::ordered_json json{{"schema", "plumb.truth/1"},
                              {"command", invocation.command_line()},
                              {"caster", options.caster},
                              {"rays", cast.hits.size()},
                              {"hits", hits},
                              {"checksum", fmt::format("{:016x}", checksum(cast.hits))}};
  if (agreement != nullptr) {
    json["witness"] = {{"agrees", agreement->agrees()},
                       {"one_misses", agreement->one_misses},
                       {"apart", agreement->apart},
                       {"largest_px", agreement->largest_px},
                       {"other_triangle", agreement->other_triangle}};
  }
  json["timing"] = {{"build_s", cast.build_s}, {"cast_s", cast.cast_s}};
  return json.dump(2) + "\n";
}

// Of stacks, whose surface is a mesh, for which there is one caster.
std::optional<DrawnSurface> full_detail_mesh(const TruthOptions& options,
                                             const terrain::Heightfield& field) {
  if (field.stacks == nullptr) return std::nullopt;
  const std::string& source = field.provenance.source;
  if (options.witness || options.caster == "pyramid")
    input_error("{}: {} is a terrain of stacks, at which Embree alone casts",
                options.witness ? "--witness" : "--caster pyramid", source);
  return audit::full_detail_of_stacks(audit::built_in_methods(), field);
}

int run_truth(TruthOptions options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  const Target target = target_of(options);
  std::optional<image::ColourImage> drape;
  if (!options.drape.empty()) drape = image::read_colour(options.drape);
  Progress progress;
  progress.step("reading the terrain");
  const terrain::Heightfield field = load(options.terrain);
  const terrain::Diagonal diagonal = terrain::parse_diagonal(options.terrain.diagonal);
  const audit::PlacedCamera view = placed_camera(options.camera, field);
  const Camera& camera = view.camera;
  audit::require_frame_memory(camera, (options.witness ? 2 : 1) * audit::kHitBytes +
                                          (target == Target::None ? 0 : audit::kPictureBytes));
  const std::optional<DrawnSurface> mesh = full_detail_mesh(options, field);
  if (options.caster.empty()) options.caster = mesh ? "embree" : "pyramid";
  progress.step("casting rays");
  const Cast found = mesh ? cast_with([&] { return reference::EmbreeCaster(*mesh->mesh); }, camera)
                          : cast(options.caster, field, diagonal, camera);
  std::int64_t hits = 0;
  for (std::size_t pixel = 0; pixel < found.hits.size(); ++pixel) hits += found.hits.hit(pixel);
  std::optional<audit::CasterAgreement> agreement;
  if (options.witness) {
    progress.step("asking the witness");
    const Cast other =
        cast(options.caster == "embree" ? "pyramid" : "embree", field, diagonal, camera);
    agreement = audit::compare_casters(found.hits, other.hits, camera);
  }
  if (target != Target::None) {
    progress.step("writing the picture");
    write_picture(options, target, field, mesh ? &*mesh : nullptr, found.hits, view,
                  drape ? &*drape : nullptr);
  }
  progress.finish();
  const int status = agreement && !agreement->agrees() ? 1 : 0;
  if (target == Target::StandardOutput) return status;
  const audit::CasterAgreement* judged = agreement ? &*agreement : nullptr;
  std::cout << (options.json ? truth_json(options, invocation, found, hits, judged)
                             : truth_text(options, found, hits, judged));
  return status;
}

}  // namespace

Command truth_command() {
  Command command;
  command.name = "truth";
  command.summary =
      "Cast rays at the full-detail surface; with --witness by two casters that must agree (exit "
      "status 1 if not)";
  command.example =
      "plumb truth 'generate:alpine?size=513' --camera oblique --size 640x360 --witness -o "
      "truth.exr";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<TruthOptions>();
    add_terrain_options(options, values->terrain);
    add_camera_options(options, values->camera);
    options.group("Truth");
    options.choice(values->caster, "--caster", {"pyramid", "embree"},
                   "Who casts: the min/max pyramid (default), or Embree with decisions in double "
                   "(the only one for terrains of stacks)");
    options.flag(values->witness, "--witness", "Ask the other caster as well and compare");
    options.group("Output");
    add_output_option(options, values->output,
                      "Write the picture: .exr with every channel, .png as a preview, or - for the "
                      "EXR on standard output");
    add_drape_option(options, values->drape);
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_truth(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
