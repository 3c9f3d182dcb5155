#include "stranger.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "audit/depth_fit.h"
#include "audit/depth_meaning.h"
#include "audit/depth_picture.h"
#include "audit/mesh_fit.h"
#include "common_options.h"
#include "core/check.h"
#include "image/depth_file.h"
#include "terrain/mesh_file.h"

namespace plumb::tool {
namespace {

constexpr const char* kDiagonalNote =
    "A renderer whose cells are all cut the same way is judged by --diagonal fixed; another "
    "diagonal shows as up to half of a cell's twist.";

constexpr const char* kTrustNote = " (--trust audits it all the same)";

void require_positive(const std::optional<double>& value, const char* option) {
  if (value && !(*value > 0.0 && std::isfinite(*value)))
    input_error("{} {}: expected a positive number", option, *value);
}

terrain::MeshReadOptions mesh_options(const StrangerOptions& options) {
  terrain::MeshReadOptions read;
  read.up_axis = options.up == "y" ? terrain::UpAxis::Y : terrain::UpAxis::Z;
  read.metres_per_unit = options.scale.value_or(1.0);
  if (!options.offset.empty()) read.origin_m = parse_point(options.offset, "--offset");
  return read;
}

image::DepthBuffer read_buffer(const StrangerOptions& options, const Camera& camera) {
  image::DepthReadOptions read;
  read.channel = options.depth_channel;
  read.raw_width_px = camera.width_px;
  read.raw_height_px = camera.height_px;
  if (!options.depth_raw.empty())
    read.raw = options.depth_raw == "big" ? image::RawOrder::Big : image::RawOrder::Little;
  image::DepthBuffer buffer = image::read_depth(options.depth_file, read);
  if (options.depth_bits > 0) buffer.format = {24, options.depth_bits};
  if (buffer.width_px != camera.width_px || buffer.height_px != camera.height_px)
    input_error(
        "depth '{}': the buffer has {} x {} pixels, the camera {} x {} (--size, or width and "
        "height in the camera's file)",
        options.depth_file, buffer.width_px, buffer.height_px, camera.width_px, camera.height_px);
  return buffer;
}

audit::DepthMeaning meaning_of(const StrangerOptions& options) {
  audit::DepthMeaning meaning;
  if (!options.depth_convention.empty())
    meaning.convention = audit::parse_depth_convention(options.depth_convention);
  meaning.rows_from_bottom = options.depth_y == "up";
  meaning.metres_per_unit = options.depth_scale.value_or(1.0);
  meaning.sky = options.depth_sky;
  const bool is_window = meaning.convention != audit::DepthConvention::Linear &&
                         meaning.convention != audit::DepthConvention::Distance;
  if (is_window && options.depth_scale)
    input_error("--depth-scale is of --depth-convention linear and distance, not of {}",
                audit::name_of(meaning.convention));
  return meaning;
}

void require_numbers(const StrangerOptions& options, const image::DepthBuffer& buffer) {
  std::size_t count = 0, first = 0;
  for (std::size_t k = 0; k < buffer.size(); ++k) {
    if (!std::isnan(buffer.values[k])) continue;
    if (count++ == 0) first = k;
  }
  if (count == 0) return;
  const auto width = static_cast<std::size_t>(buffer.width_px);
  input_error("depth '{}': {} of its {} numbers are NaN, the first in column {} of row {}",
              options.depth_file, count, buffer.size(), first % width, first / width);
}

void require_depths(const StrangerOptions& options, const audit::DepthPicture& picture,
                    const audit::DepthMeaning& meaning) {
  if (picture.no_depths == 0) return;
  input_error(
      "depth '{}': {} of its numbers are no depth of convention {}, the first {} at pixel ({}, "
      "{}); a number that stands for sky is named by --depth-sky",
      options.depth_file, picture.no_depths, audit::name_of(meaning.convention),
      picture.first_number, picture.first_x, picture.first_y);
}

std::string convention_line(const audit::DepthMeaning& meaning, const Camera& camera) {
  const char* rows = meaning.rows_from_bottom ? "bottom up" : "top down";
  switch (meaning.convention) {
    case audit::DepthConvention::Linear:
    case audit::DepthConvention::Distance:
      return fmt::format("the depth buffer's numbers are {} in units of {} m, its rows run {}",
                         meaning.convention == audit::DepthConvention::Linear
                             ? "depths along the view"
                             : "distances along the ray",
                         meaning.metres_per_unit, rows);
    default:
      return fmt::format(
          "the depth buffer's numbers are {} depths of the camera's near plane at {} m and far "
          "plane at {} m, its rows run {}",
          audit::name_of(meaning.convention), camera.near_m, camera.far_m, rows);
  }
}

}  // namespace

std::string StrangerOptions::name() const {
  return is_mesh() ? "mesh " + mesh_file : "depth " + depth_file;
}

void add_stranger_options(Options& options, StrangerOptions& stranger) {
  options.group("A mesh in place of a method; its claim is --tolerance");
  options.text(stranger.mesh_file, "--mesh", "FILE",
               "Audit the triangles of this PLY, OBJ (both in double), STL, glTF or GLB file (in "
               "single precision)");
  options.choice(stranger.up, "--up", {"z", "y"},
                 "The mesh's upward axis (z); with y, its -z is north");
  options.number(stranger.scale, "--scale", "FACTOR", "Metres per unit of the mesh (1)");
  options.text(stranger.offset, "--offset", "X,Y,Z",
               "Where the mesh's (0, 0, 0) lies in the terrain's coordinates, metres (what a PLY "
               "file's comment origin_m says, else 0,0,0)");
  options.group("A depth buffer in place of a method; its claim is --tolerance");
  options.text(stranger.depth_file, "--depth", "FILE",
               "Audit the points of this depth buffer (EXR, PFM, TIFF, PNG of 16 bits; raw floats "
               "with --depth-raw), drawn through --camera");
  options.choice(stranger.depth_convention, "--depth-convention", audit::depth_convention_names(),
                 "What its numbers are (linear: view depth); window, also called opengl, d3d and "
                 "vulkan, runs from 0 near to 1 far");
  options.choice(stranger.depth_y, "--depth-y", {"down", "up"},
                 "Which way its rows run (down: the first is the highest)");
  options.text(stranger.depth_channel, "--depth-channel", "NAME",
               "Its channel (Z, or the only one)");
  options.number(stranger.depth_scale, "--depth-scale", "FACTOR",
                 "Metres per unit of linear depth or distance (1; negative where the numbers are)");
  options.number(stranger.depth_sky, "--depth-sky", "V",
                 "A number that means sky, beside +inf and what the far end of window depth is "
                 "cleared to");
  options.integer(
      stranger.depth_bits, "--depth-bits", "N",
      "It was copied from a buffer of so many bits, 16, 24 or 32, whose steps are coarser "
      "than the file's",
      1, 32);
  options.choice(
      stranger.depth_raw, "--depth-raw", {"little", "big"},
      "It holds nothing but floats of this byte order, as many as the camera has pixels");
  options.group("Whether they fit");
  options.flag(stranger.trusted, "--trust",
               "Audit a mesh or depth buffer that seems to be of another camera, convention, place "
               "or terrain, which ends with status 2 otherwise");
}

void require_consistent(const StrangerOptions& s, const std::vector<std::string>& arguments) {
  if (s.is_mesh() && s.is_depth())
    input_error("--mesh and --depth: expected one of them, each is an audit of its own");
  const auto only_of = [](bool given, const char* option, bool has, const char* other) {
    if (given && !has) input_error("{} belongs to {}, which is not there", option, other);
  };
  only_of(!s.offset.empty(), "--offset", s.is_mesh(), "--mesh");
  only_of(!s.up.empty(), "--up", s.is_mesh(), "--mesh");
  only_of(s.scale.has_value(), "--scale", s.is_mesh(), "--mesh");
  only_of(!s.depth_convention.empty(), "--depth-convention", s.is_depth(), "--depth");
  only_of(!s.depth_y.empty(), "--depth-y", s.is_depth(), "--depth");
  only_of(!s.depth_channel.empty(), "--depth-channel", s.is_depth(), "--depth");
  only_of(s.depth_scale.has_value(), "--depth-scale", s.is_depth(), "--depth");
  only_of(s.depth_sky.has_value(), "--depth-sky", s.is_depth(), "--depth");
  only_of(s.depth_bits > 0, "--depth-bits", s.is_depth(), "--depth");
  only_of(!s.depth_raw.empty(), "--depth-raw", s.is_depth(), "--depth");
  only_of(s.trusted, "--trust", s.is_given(), "--mesh or --depth");
  require_positive(s.scale, "--scale");
  if (s.depth_scale && !(*s.depth_scale != 0.0 && std::isfinite(*s.depth_scale)))
    input_error("--depth-scale {}: expected a number, not zero", *s.depth_scale);
  if (s.depth_bits != 0 && s.depth_bits != 16 && s.depth_bits != 24 && s.depth_bits != 32)
    input_error("--depth-bits {}: expected 16, 24 or 32", s.depth_bits);
  if (!s.depth_raw.empty() && !s.depth_channel.empty())
    input_error("--depth-channel: raw floats have no channels");
  if (!s.is_given()) return;
  for (const char* option : {"--method", "--variant", "--set"}) {
    for (const std::string& argument : arguments) {
      if (argument == option || argument.starts_with(std::string(option) + "="))
        input_error("{}: nothing is drawn by a method where --{} has a surface", option,
                    s.is_mesh() ? "mesh" : "depth");
    }
  }
}

Stranger read_stranger_mesh(const StrangerOptions& options, const audit::TruthTerms& truth,
                            const Camera& camera, const Tolerance& tolerance) {
  const terrain::MeshReadOptions read = mesh_options(options);
  terrain::MeshFile file = terrain::read_mesh(options.mesh_file, read);
  Stranger stranger;
  stranger.warnings = file.warnings;
  const audit::HeightfieldTruth* heights = truth.heights();
  // Whether it lies elsewhere within the terrain is told of heights alone.
  const auto misfit = heights != nullptr
                          ? audit::misfit_of_mesh(*heights, file.mesh, read, camera, tolerance)
                          : std::nullopt;
  if (misfit) {
    if (misfit->refuses && !options.trusted)
      input_error("mesh '{}': {}{}", options.mesh_file, misfit->text, kTrustNote);
    stranger.hints.push_back(misfit->text);
    stranger.warnings.push_back(misfit->text);
  } else if (const auto elsewhere = terrain::misplacement(file.mesh, truth.field())) {
    input_error("mesh '{}': {}", options.mesh_file, *elsewhere);
  }
  terrain::move_to_origin_of(truth.field(), file.mesh);
  stranger.assumptions = std::move(file.assumptions);
  auto mesh = std::make_shared<TriangleMesh>(std::move(file.mesh));
  DrawnSurface& surface = stranger.surface;
  surface.cost.vertices = static_cast<std::int64_t>(mesh->vertices_m.size());
  surface.cost.triangles = static_cast<std::int64_t>(mesh->triangles.size());
  surface.mesh = std::move(mesh);
  const Measure measure = heights == nullptr              ? Measure::NearestError
                          : tolerance.unit == Unit::Pixel ? Measure::PixelError
                                                          : Measure::SampleError;
  surface.claims.push_back({measure, tolerance.value, tolerance.unit});
  surface.notes.push_back(fmt::format(
      "A mesh from a file claims --tolerance ({}: the {}) and to have no hole; --limit has more "
      "judged. Its silhouettes may move by --tolerance; where they move farther, terrain seen past "
      "them counts as see-through.",
      to_text(tolerance),
      heights == nullptr              ? "distance to the nearest point, both ways"
      : tolerance.unit == Unit::Pixel ? "pixel error"
                                      : "sample error"));
  if (heights != nullptr) surface.notes.push_back(kDiagonalNote);
  return stranger;
}

DepthFrame read_depth_frame(const StrangerOptions& options, const audit::HeightfieldTruth& truth,
                            const Camera& camera, const audit::Band& band,
                            const Tolerance& tolerance) {
  const audit::DepthMeaning meaning = meaning_of(options);
  const image::DepthBuffer buffer = read_buffer(options, camera);
  require_numbers(options, buffer);
  DepthFrame frame;
  frame.true_hits = truth.caster.cast_frame(camera);
  Stranger& stranger = frame.stranger;
  if (const auto misfit =
          audit::misfit_of_depth(truth, frame.true_hits, buffer, meaning, camera, tolerance)) {
    if (misfit->refuses && !options.trusted)
      input_error("depth '{}': {}{}", options.depth_file, misfit->text, kTrustNote);
    stranger.hints.push_back(misfit->text);
    stranger.warnings.push_back(misfit->text);
  }
  audit::DepthPicture picture =
      audit::depth_picture(truth, frame.true_hits, buffer, meaning, camera, band);
  require_depths(options, picture, meaning);
  stranger.assumptions = {convention_line(meaning, camera),
                          audit::rounding_text(picture, buffer.format)};
  stranger.parameters = {{"convention", audit::name_of(meaning.convention)},
                         {"rows", meaning.rows_from_bottom ? "up" : "down"},
                         {"numbers", image::to_text(buffer.format)}};
  if (!buffer.channel.empty()) stranger.parameters.emplace_back("channel", buffer.channel);
  frame.drawn = picture.image;
  stranger.surface = audit::surface_of(std::move(picture.image));
  stranger.surface.claims.push_back({Measure::PixelError, tolerance.value, tolerance.unit});
  stranger.surface.notes.push_back(fmt::format(
      "A depth buffer claims --tolerance ({}, the pixel error) and to have no hole. It cannot tell "
      "the error of samples, what lies behind what is seen, edges, T-junctions, normals or levels.",
      to_text(tolerance)));
  stranger.surface.notes.push_back(kDiagonalNote);
  return frame;
}

}  // namespace plumb::tool
