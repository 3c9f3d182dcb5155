// What is in a container of patches, said without decoding it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "command.h"
#include "mesh/patch_quadtree/container.h"

namespace plumb::tool {

/// Sizes of the records of a level. Of version 1, the record of a family counts for the level of
/// its children.
struct LevelBytes {
  int columns = 0, rows = 0;  // of patches
  std::int64_t heights = 0, payload = 0;
};
/// The finest level first.
std::vector<LevelBytes> level_bytes(const mesh::patch_quadtree::Container& container);

/// Of the whole file, for each sample of the terrain.
double bits_per_sample(const mesh::patch_quadtree::Container& container);
/// How many times as large two bytes a sample are.
double ratio_to_16_bits(const mesh::patch_quadtree::Container& container);

const char* name_of(mesh::patch_quadtree::Payload payload);

/// Tables for a person, and one JSON object.
std::string container_text(const mesh::patch_quadtree::Container& container);
std::string container_json(const mesh::patch_quadtree::Container& container,
                           const Invocation& invocation);

}  // namespace plumb::tool
