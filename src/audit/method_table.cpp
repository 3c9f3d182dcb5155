// The only registry of methods: a row for each.
#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include "audit/method.h"
#include "audit/profile_file.h"
#include "core/check.h"
#include "core/number_text.h"
#include "mesh/full/full_detail.h"
#include "mesh/restricted_quadtree/restricted_quadtree.h"
#include "mesh/stacks/stacks.h"
#include "mesh/tessellation/tessellation.h"
#include "slicing/slicing_method.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::audit {
namespace {

int integer_parameter(const MethodChoice& choice, const std::string& name, int otherwise) {
  const auto found = choice.parameters.find(name);
  if (found == choice.parameters.end()) return otherwise;
  const auto value = parse_integer(found->second);
  if (!value || *value < 0 || *value > 1'000'000)
    input_error("parameter {}: expected a whole number, got '{}'", name, found->second);
  return static_cast<int>(*value);
}

Method full() {
  return {"full",
          "every sample a vertex: the baseline, exact by construction",
          {"conservative"},
          {Unit::Pixel, Unit::Metre},
          terrain::Diagonal::Alternating,
          {},
          [](const terrain::Heightfield& field, const MethodChoice&) {
            return adapt(mesh::full::prepare(field), mesh::full::draw);
          }};
}

Method restricted_quadtree() {
  namespace method = mesh::restricted_quadtree;
  return {
      "restricted-quadtree",
      "right triangles bisected where the error asks for it, over the whole terrain",
      {"conservative"},
      {Unit::Pixel, Unit::Metre},
      terrain::Diagonal::Alternating,
      {{"patch_cells", "cells along the side of a piece that reports name, a power of two (128)"}},
      [](const terrain::Heightfield& field, const MethodChoice& choice) {
        method::Parameters parameters;
        parameters.patch_cells = integer_parameter(choice, "patch_cells", parameters.patch_cells);
        return adapt(method::prepare(field, parameters), method::draw);
      }};
}

enum class Least { AboveZero, Zero };

double number_parameter(const MethodChoice& choice, const std::string& name, double otherwise,
                        Least least = Least::AboveZero) {
  const auto found = choice.parameters.find(name);
  if (found == choice.parameters.end()) return otherwise;
  const auto value = parse_number(found->second);
  const bool fits = value && (least == Least::Zero ? *value >= 0.0 : *value > 0.0);
  if (!fits || !std::isfinite(*value))
    input_error("parameter {}: expected a number {}, got '{}'", name,
                least == Least::Zero ? "of at least zero" : "above zero", found->second);
  return *value;
}

// The value that a word stands for; the first one if the parameter is left out.
template <class Value>
Value word_parameter(const MethodChoice& choice, const std::string& name,
                     const std::vector<std::pair<std::string, Value>>& words) {
  const auto found = choice.parameters.find(name);
  if (found == choice.parameters.end()) return words.front().second;
  std::string known;
  for (const auto& [word, value] : words) {
    if (word == found->second) return value;
    known += (known.empty() ? "" : ", ") + word;
  }
  input_error("parameter {}: expected one of {}, got '{}'", name, known, found->second);
}

slicing::Parameters slicing_parameters(const MethodChoice& choice, bool hybrid) {
  slicing::Parameters parameters;
  parameters.cut.hybrid = hybrid;
  parameters.cut.variant =
      choice.variant == "published" ? slicing::Variant::Published : slicing::Variant::Conservative;
  parameters.leaf_cells = integer_parameter(choice, "leaf_cells", parameters.leaf_cells);
  if (parameters.leaf_cells < 2 || parameters.leaf_cells > 256 || parameters.leaf_cells % 2 != 0)
    input_error("parameter leaf_cells: expected an even number from 2 to 256, got {}",
                parameters.leaf_cells);
  parameters.cut.descend_factor =
      number_parameter(choice, "descend", parameters.cut.descend_factor);
  parameters.choice = word_parameter<slicing::CutChoice>(
      choice, "cut",
      {{"greedy", slicing::CutChoice::Greedy}, {"optimum", slicing::CutChoice::Optimum}});
  parameters.heights = word_parameter<slicing::Interpolation>(
      choice, "heights",
      {{"triangulated", slicing::Interpolation::Triangulated},
       {"bilinear", slicing::Interpolation::Bilinear},
       {"nearest", slicing::Interpolation::Nearest},
       {"eight-bit", slicing::Interpolation::EightBit},
       {"mip-mapped", slicing::Interpolation::MipMapped}});
  parameters.renderer = word_parameter<slicing::SliceRenderer>(
      choice, "renderer",
      {{"rays", slicing::SliceRenderer::Rays}, {"quads", slicing::SliceRenderer::Quads}});
  parameters.cut.borders = word_parameter<bool>(choice, "borders", {{"on", true}, {"off", false}});
  slicing::BlendOptions& blend = parameters.blend;
  blend.falloff_px = number_parameter(choice, "antialias", blend.falloff_px, Least::Zero);
  blend.fog_per_m = 1e-3 * number_parameter(choice, "fog", blend.fog_per_m, Least::Zero);
  blend.fog_height_m = number_parameter(choice, "fog_height", blend.fog_height_m);
  const auto profile = choice.parameters.find("profile");
  if (profile != choice.parameters.end()) parameters.cut.profile = parse_profile(profile->second);
  return parameters;
}

Method slicing_row(const std::string& name, const std::string& summary, bool hybrid) {
  Method method;
  method.name = name;
  method.summary = summary;
  method.variants = {"conservative", "published"};
  method.tolerance_units = {Unit::Pixel};
  method.parameters = {
      {"leaf_cells", "cells along the side of the smallest box, even (8)"},
      {"descend", "descend where a box costs more than this times its children (0.9)"},
      {"cut", "greedy, as the article has it, or optimum, by dynamic programming (greedy)"},
      {"heights",
       "how they are looked up: triangulated, bilinear, nearest, eight-bit or mip-mapped "
       "(triangulated)"},
      {"borders", "of published slices, a pixel wide: on or off (on)"},
      {"antialias",
       "pixels above the ground over which a slice's opacity falls to zero (it ends sharply)"},
      {"fog", "light lost on a kilometre of fog at the terrain's lowest point, 1/km (none)"},
      {"fog_height", "metres of height over which fog thins to 1/e (100)"},
      {"renderer", "rays, or quads through the rasteriser (rays)"},
      {"profile",
       "speeds for the cost model: a name, a .toml file or NAME,VERTICES_PER_S,"
       "PIXELS_PER_S (geforce2-mx)"}};
  method.prepare = [hybrid](const terrain::Heightfield& field, const MethodChoice& choice) {
    return adapt(
        slicing::prepare(field, terrain::Diagonal::Alternating, slicing_parameters(choice, hybrid)),
        slicing::draw);
  };
  method.resolve = [](MethodChoice choice) {
    const auto profile = choice.parameters.find("profile");
    if (profile != choice.parameters.end())
      profile->second = to_text(parse_profile(profile->second));
    return choice;
  };
  return method;
}

namespace tessellation = mesh::tessellation;

// "all", or causes with commas between them.
tessellation::Mends mends_parameter(const MethodChoice& choice) {
  tessellation::Mends mends{};
  const auto found = choice.parameters.find("mend");
  if (found == choice.parameters.end()) return mends;
  if (choice.variant != "published")
    input_error("parameter mend: the {} variant has nothing to mend", choice.variant);
  std::string known = "all";
  for (std::size_t k = 0; k < tessellation::kCauses; ++k)
    known += std::string(", ") + tessellation::name_of(static_cast<tessellation::Cause>(k));
  for (std::size_t at = 0; at <= found->second.size();) {
    const std::size_t end = std::min(found->second.find(',', at), found->second.size());
    const std::string word = found->second.substr(at, end - at);
    bool is_known = word == "all";
    for (std::size_t k = 0; k < tessellation::kCauses; ++k) {
      const bool named = word == tessellation::name_of(static_cast<tessellation::Cause>(k));
      mends[k] = mends[k] || named || word == "all";
      is_known = is_known || named;
    }
    if (!is_known) input_error("parameter mend: expected one of {}, got '{}'", known, word);
    at = end + 1;
  }
  return mends;
}

int power_parameter(const MethodChoice& choice, const std::string& name, int otherwise, int most) {
  const int value = integer_parameter(choice, name, otherwise);
  if (value < 8 || value > most || !std::has_single_bit(static_cast<unsigned>(value)))
    input_error("parameter {}: expected a power of two from 8 to {}, got {}", name, most, value);
  return value;
}

std::unique_ptr<PreparedMethod> prepare_tessellation(const terrain::Heightfield& field,
                                                     const MethodChoice& choice, bool fine) {
  if (field.columns() < 2 || field.rows() < 2)
    input_error("{}: patches need 2 x 2 samples, the terrain has {} x {}", field.provenance.source,
                field.columns(), field.rows());
  tessellation::Parameters parameters;
  parameters.variant = choice.variant == "published" ? tessellation::Variant::Published
                                                     : tessellation::Variant::Conservative;
  parameters.fine_selection = fine;
  parameters.mends = mends_parameter(choice);
  const auto file = choice.parameters.find("prepared");
  if (file != choice.parameters.end()) {
    for (const char* name : {"error", "patch_cells", "block_cells", "format_version"}) {
      if (choice.parameters.contains(name))
        input_error("parameter {}: it is the prepared file's, leave it out", name);
    }
    return adapt(tessellation::prepare(field, std::filesystem::path(file->second), parameters),
                 tessellation::draw);
  }
  parameters.error_m = number_parameter(choice, "error", parameters.error_m);
  parameters.patch_cells = power_parameter(choice, "patch_cells", parameters.patch_cells, 1024);
  parameters.block_cells = power_parameter(choice, "block_cells", parameters.block_cells,
                                           std::min(64, parameters.patch_cells));
  parameters.format_version =
      word_parameter<std::uint32_t>(choice, "format_version", {{"2", 2}, {"1", 1}});
  return adapt(tessellation::prepare(field, parameters), tessellation::draw);
}

Method tessellation_row(const std::string& name, const std::string& summary, bool fine) {
  Method method;
  method.name = name;
  method.summary = summary;
  method.variants = {"conservative", "published"};
  method.tolerance_units = {Unit::Pixel, Unit::Metre};
  method.truth = terrain::Diagonal::Blocks8;
  method.parameters = {
      {"error", "metres that a coded height may be off (next to none: millimetres)"},
      {"patch_cells", "cells along a patch, a power of two from 8 to 1024 (128)"},
      {"block_cells", "cells along a block, a power of two from 8 to 64 (8)"},
      {"format_version", "of the coded heights: 2 modelled, 1 as published (2)"},
      {"prepared", "a file of plumb build, in place of all of these"},
      {"mend",
       "causes that the published variant is mended of: edge-midpoint, view-from-above, "
       "not-monotone, mixed-factors, inner-minimum, distance-test, bilinear-error, with commas, "
       "or all (none)"}};
  method.prepare = [fine](const terrain::Heightfield& field, const MethodChoice& choice) {
    return prepare_tessellation(field, choice, fine);
  };
  return method;
}

mesh::stacks::Parameters stacks_parameters(const MethodChoice& choice) {
  using mesh::dual_contouring::Kernel;
  using mesh::dual_contouring::Placement;
  mesh::stacks::Parameters parameters;
  parameters.variant = choice.variant == "published" ? mesh::stacks::Variant::Published
                                                     : mesh::stacks::Variant::Conservative;
  parameters.placement = word_parameter<Placement>(
      choice, "placement",
      {{"mean", Placement::Mean}, {"qef", Placement::Qef}, {"particle", Placement::Particle}});
  parameters.filter.kernel =
      word_parameter<Kernel>(choice, "filter", {{"gauss", Kernel::Gauss}, {"box", Kernel::Box}});
  parameters.filter.radius = integer_parameter(choice, "radius", parameters.filter.radius);
  if (parameters.filter.radius > 4)
    input_error("parameter radius: expected 0 to 4 voxels, got {}", parameters.filter.radius);
  return parameters;
}

// Frames of a path share a tree where there is a budget.
class PreparedStacks final : public PreparedMethod {
 public:
  PreparedStacks(mesh::stacks::Prepared prepared, int budget)
      : prepared_(std::move(prepared)), budget_(budget) {}

  DrawnSurface draw(const Camera& camera, const Tolerance& tolerance) const override {
    return mesh::stacks::draw(prepared_, camera, tolerance);
  }
  std::unique_ptr<MethodRun> start() const override {
    return std::make_unique<Flight>(mesh::stacks::Run(prepared_, budget_));
  }

 private:
  class Flight final : public MethodRun {
   public:
    explicit Flight(mesh::stacks::Run run) : run_(std::move(run)) {}
    DrawnSurface step(const Camera& camera, const Tolerance& tolerance) override {
      return run_.step(camera, tolerance);
    }

   private:
    mesh::stacks::Run run_;
  };

  mesh::stacks::Prepared prepared_;
  int budget_;
};

Method stacks_row() {
  Method method;
  method.name = "stacks";
  method.summary = "stacks of material, their surface by dual contouring over an octree";
  method.variants = {"conservative", "published"};
  method.tolerance_units = {Unit::Pixel};
  method.takes_stacks = true;
  method.size_variants = {"published"};
  method.parameters = {
      {"placement", "of vertices: mean, qef or particle (mean)"},
      {"filter", "that smoothes the densities: gauss or box (gauss)"},
      {"radius", "of the filter, voxels, 0 to 4 (1)"},
      {"budget", "node meshes that a frame of a path may make, as the paper's 40; 0: all (0)"},
      {"voxel", "height of a voxel of a terrain of heights, metres (the mean spacing)"}};
  method.prepare = [](const terrain::Heightfield& field, const MethodChoice& choice) {
    if (field.stacks != nullptr && choice.parameters.contains("voxel"))
      input_error("parameter voxel: a terrain of stacks has its own, {} m", field.stacks->voxel_m);
    const double voxel_m = number_parameter(choice, "voxel", 0.0);
    mesh::stacks::Parameters parameters = stacks_parameters(choice);
    parameters.is_truth = field.stacks != nullptr;
    return std::make_unique<PreparedStacks>(
        mesh::stacks::prepare(
            field.stacks != nullptr ? *field.stacks : terrain::stacks_of(field, voxel_m),
            parameters),
        integer_parameter(choice, "budget", 0));
  };
  method.full_detail = [](const terrain::Heightfield& field, const MethodChoice& choice) {
    mesh::stacks::Parameters parameters = stacks_parameters(choice);
    parameters.variant = mesh::stacks::Variant::Conservative;
    DrawnSurface finest = mesh::stacks::finest(mesh::stacks::prepare(*field.stacks, parameters));
    finest.patches.clear();  // one piece of one level
    finest.triangle_lod.clear();
    return finest;
  };
  return method;
}

}  // namespace

const MethodTable& built_in_methods() {
  static const MethodTable table{
      full(),
      restricted_quadtree(),
      tessellation_row("tessellation",
                       "patches of a compressed quadtree, their blocks refined by a tessellator",
                       true),
      tessellation_row("chunked",
                       "the same patches without fine selection: chunked level of detail", false),
      stacks_row(),
      slicing_row("slicing", "stacks of slices through the terrain; polygons where none can be",
                  false),
      slicing_row("hybrid-slicing", "slices or polygons for each box, whichever costs less", true)};
  return table;
}

}  // namespace plumb::audit
