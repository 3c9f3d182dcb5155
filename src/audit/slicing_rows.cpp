// Slicing and hybrid slicing, as the table of methods has them.
#include "audit/method_parameters.h"
#include "audit/method_rows.h"
#include "audit/profile_file.h"
#include "slicing/slicing_method.h"

namespace plumb::audit {
namespace {

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

}  // namespace

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

}  // namespace plumb::audit
