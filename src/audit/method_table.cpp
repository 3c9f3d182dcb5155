// The only registry of methods: a row for each.
#include "audit/method.h"
#include "core/check.h"
#include "core/number_text.h"
#include "mesh/full/full_detail.h"
#include "mesh/restricted_quadtree/restricted_quadtree.h"

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

}  // namespace

const MethodTable& built_in_methods() {
  static const MethodTable table{full(), restricted_quadtree()};
  return table;
}

}  // namespace plumb::audit
