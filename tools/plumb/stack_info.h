// What a file of stacks holds, in words and as JSON.
#pragma once

#include <cstdint>
#include <string>

#include "command.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::tool {

/// Size, place, layers, materials with volume and share, and bytes against voxels of one byte.
std::string stacks_text(const terrain::StackField& field, const std::string& file,
                        std::int64_t bytes);
std::string stacks_json(const terrain::StackField& field, const std::string& file,
                        std::int64_t bytes, const Invocation& invocation);

}  // namespace plumb::tool
