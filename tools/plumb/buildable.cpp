#include "buildable.h"

#include <utility>

#include "core/check.h"

namespace plumb::tool {
namespace {

using mesh::patch_quadtree::Bytes;

// Heights alone.
Bytes file_of_heights(const terrain::Heightfield& field,
                      const mesh::patch_quadtree::EncodeOptions& options) {
  mesh::patch_quadtree::EncodedHeights encoded =
      mesh::patch_quadtree::encode_heights(field, options);
  const auto patches = static_cast<std::size_t>(encoded.header.layout.patch_count());
  return container_bytes(encoded.header, {std::move(encoded.heights), std::vector<Bytes>(patches)});
}

}  // namespace

std::vector<Buildable> buildables() { return {{"tessellation", file_of_heights}}; }

Buildable buildable(const std::string& method) {
  std::string known;
  for (Buildable& row : buildables()) {
    if (row.method == method) return std::move(row);
    known += (known.empty() ? "" : ", ") + row.method;
  }
  input_error("--method '{}' has no file to be built, there are: {}", method, known);
}

}  // namespace plumb::tool
