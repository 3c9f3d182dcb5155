// The baseline and the restricted quadtree, as the table of methods has them.
#include "audit/method_parameters.h"
#include "audit/method_rows.h"
#include "mesh/full/full_detail.h"
#include "mesh/restricted_quadtree/restricted_quadtree.h"

namespace plumb::audit {

Method full_row() {
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

Method restricted_quadtree_row() {
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

}  // namespace plumb::audit
