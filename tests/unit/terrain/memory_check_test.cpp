#include "terrain/memory_check.h"

#include <gtest/gtest.h>

#include "core/check.h"

namespace plumb::terrain {
namespace {

TEST(MemoryCheck, WhatFitsPasses) {
  EXPECT_NO_THROW(require_memory("a", 10, 10, 4, 400));
  EXPECT_NO_THROW(require_memory("a", 1, 1, 4));
}

TEST(MemoryCheck, WhatDoesNotFitSaysHowMuchIsNeededAndThere) {
  try {
    require_memory("a.tif", 10, 10, 4, 399);
    FAIL() << "it was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a.tif: 10 x 10 samples need 400 bytes of memory, there are 399");
  }
}

TEST(MemoryCheck, MoreCellsThanCanBeCountedAreRefused) {
  const std::uint64_t plenty = std::uint64_t{1} << 60;
  EXPECT_NO_THROW(require_memory("a", 46341, 46341, 4, plenty));
  EXPECT_THROW(require_memory("a", 46342, 46342, 4, plenty), InputError);  // 46341^2 > 2^31 - 2
  EXPECT_THROW(require_memory("a", 2147483647, 2147483647, 4, plenty), InputError);
}

TEST(MemoryCheck, ThisMachineHasSome) { EXPECT_GT(available_memory_bytes(), 1u << 20); }

}  // namespace
}  // namespace plumb::terrain
