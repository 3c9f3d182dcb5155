#include "buildable.h"

#include <utility>

#include "core/check.h"
#include "mesh/tessellation/build.h"

namespace plumb::tool {
namespace {

Bytes tessellation_file(const terrain::Heightfield& field,
                        const mesh::patch_quadtree::EncodeOptions& options) {
  mesh::tessellation::BuildOptions with_bounds;
  with_bounds.heights = options;
  return mesh::tessellation::build(field, with_bounds);
}

}  // namespace

std::vector<Buildable> buildables() { return {{"tessellation", tessellation_file}}; }

Buildable buildable(const std::string& method) {
  std::string known;
  for (Buildable& row : buildables()) {
    if (row.method == method) return std::move(row);
    known += (known.empty() ? "" : ", ") + row.method;
  }
  input_error("--method '{}' has no file to be built, there are: {}", method, known);
}

}  // namespace plumb::tool
