#include "core/hash.h"

#include <fmt/format.h>

namespace plumb {

std::string Checksum::text() const { return fmt::format("{:016x}", value()); }

}  // namespace plumb
