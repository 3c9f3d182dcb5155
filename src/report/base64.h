// Bytes as text.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace plumb::report {

/// Base64 of the bytes (RFC 4648, section 4: with padding, in one line).
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace plumb::report
