// Whether what is asked for fits into the memory that is there.
#pragma once

#include <cstdint>
#include <string>

namespace plumb::terrain {

/// Bytes that this process can still get: what the system says is available, or what is left of the
/// control group's or the address space's limit if that is less.
std::uint64_t available_memory_bytes();

/// Throws InputError ("NAME needs N bytes, there are M") unless `columns` x `rows` samples of
/// `bytes_per_sample` fit into `available_bytes`, and if there are more cells than a heightfield
/// may have.
void require_memory(const std::string& name, std::int64_t columns, std::int64_t rows,
                    int bytes_per_sample, std::uint64_t available_bytes = available_memory_bytes());

}  // namespace plumb::terrain
