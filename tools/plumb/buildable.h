// What plumb build can make: one row a method that has a file of its own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/patch_quadtree/coded_terrain.h"
#include "terrain/heightfield.h"

namespace plumb::tool {

struct Buildable {
  std::string method;  // "tessellation"
  /// The whole file. Throws as encode_heights does.
  std::function<Bytes(const terrain::Heightfield&, const mesh::patch_quadtree::EncodeOptions&)>
      file;
};

std::vector<Buildable> buildables();

/// The row of a method. Throws InputError that lists them if it has none.
Buildable buildable(const std::string& method);

}  // namespace plumb::tool
