// Whether what is asked for fits into the memory that is there.
#pragma once

#include <cstdint>
#include <string>

#include "core/memory.h"

namespace plumb::terrain {

/// Throws InputError ("NAME needs N bytes, there are M") unless `columns` x `rows` samples of
/// `bytes_per_sample` fit into `available_bytes`, and if there are more cells than a heightfield
/// may have.
void require_memory(const std::string& name, std::int64_t columns, std::int64_t rows,
                    int bytes_per_sample, std::uint64_t available_bytes = available_memory_bytes());

}  // namespace plumb::terrain
