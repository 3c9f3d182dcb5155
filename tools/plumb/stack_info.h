// What stacks hold, in words and as JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "command.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::tool {

/// A file of stacks, and its bytes.
struct StackFileSize {
  std::string file;
  std::int64_t bytes = 0;
};

/// Size, place, layers, materials with volume and share, and bytes against voxels of one byte;
/// without a file, those in memory alone.
std::string stacks_text(const terrain::StackField& field, const std::optional<StackFileSize>& of);
std::string stacks_json(const terrain::StackField& field, const std::optional<StackFileSize>& of,
                        const Invocation& invocation);

}  // namespace plumb::tool
