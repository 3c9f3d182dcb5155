// How much memory is asked for at once, in the whole of the program that this is linked into.
#pragma once

#include <cstddef>

namespace plumb::test_support {

/// Forgets what was asked for so far.
void forget_requests();
/// Bytes of the largest `new` since then.
std::size_t largest_request();

}  // namespace plumb::test_support
