#include "core/instruction_set.h"

#include <gtest/gtest.h>

#include "core/check.h"

namespace plumb {
namespace {

TEST(InstructionSet, BeginsWithWhatEveryProcessorHas) {
  ASSERT_FALSE(available_instruction_sets().empty());
  EXPECT_EQ(available_instruction_sets().front(), InstructionSet::Sse2);
}

TEST(InstructionSet, IsReadByName) {
  for (const InstructionSet set : available_instruction_sets())
    EXPECT_EQ(parse_instruction_set(name_of(set)), set);
}

TEST(InstructionSet, IsTheBestThereIsUnlessOneIsNamed) {
  EXPECT_EQ(parse_instruction_set(""), available_instruction_sets().back());
}

TEST(InstructionSet, RefusesANameThatItDoesNotKnow) {
  EXPECT_THROW(parse_instruction_set("avx"), InputError);
}

TEST(InstructionSet, CanBeForcedForATime) {
  const InstructionSet before = instruction_set();
  {
    const ForcedInstructionSet forced(InstructionSet::Sse2);
    EXPECT_EQ(instruction_set(), InstructionSet::Sse2);
  }
  EXPECT_EQ(instruction_set(), before);
}

}  // namespace
}  // namespace plumb
