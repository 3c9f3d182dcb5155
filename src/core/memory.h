// What fits into memory, asked before work starts.
#pragma once

#include <cstdint>
#include <string_view>

namespace plumb {

/// Bytes that this process can still get: what the system says is available, or what is left of the
/// control group's or the address space's limit if that is less.
std::uint64_t available_memory_bytes();

/// Throws InputError with the bytes needed and the bytes there unless `bytes` more fit into memory.
void require_memory(std::int64_t bytes, std::string_view what);

}  // namespace plumb
