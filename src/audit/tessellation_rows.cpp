// Tessellation with and without fine selection, as the table of methods has them.
#include <algorithm>
#include <filesystem>

#include "audit/method_parameters.h"
#include "audit/method_rows.h"
#include "mesh/tessellation/tessellation.h"

namespace plumb::audit {
namespace {

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

std::unique_ptr<PreparedMethod> prepare_tessellation(const terrain::Heightfield& field,
                                                     const MethodChoice& choice, bool fine) {
  if (field.columns() < 2 || field.rows() < 2)
    input_error("patches need 2 x 2 samples, {} has {} x {}",
                field.provenance.source.empty() ? "the terrain" : field.provenance.source,
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

}  // namespace

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

}  // namespace plumb::audit
