#include "core/instruction_set.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "core/check.h"

namespace plumb {
namespace {

constexpr int kNotForced = -1;
std::atomic<int> forced{kNotForced};

bool processor_has(InstructionSet set) {
#if defined(__x86_64__) || defined(__i386__)
  switch (set) {
    case InstructionSet::Sse2:
      return true;
    case InstructionSet::Avx2:
      return __builtin_cpu_supports("avx2");
    case InstructionSet::Avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  }
#endif
  return set == InstructionSet::Sse2;
}

}  // namespace

const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::Sse2:
      return "sse2";
    case InstructionSet::Avx2:
      return "avx2";
    case InstructionSet::Avx512:
      return "avx512";
  }
  return "?";
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const auto set : {InstructionSet::Sse2, InstructionSet::Avx2, InstructionSet::Avx512}) {
    if (processor_has(set)) sets.push_back(set);
  }
  return sets;
}

InstructionSet parse_instruction_set(const std::string& text) {
  const std::vector<InstructionSet> available = available_instruction_sets();
  if (text.empty()) return available.back();
  for (const auto set : {InstructionSet::Sse2, InstructionSet::Avx2, InstructionSet::Avx512}) {
    if (text != name_of(set)) continue;
    if (std::find(available.begin(), available.end(), set) == available.end()) {
      input_error("PLUMB_ISA is '{}', which this processor lacks; its best is '{}'", text,
                  name_of(available.back()));
    }
    return set;
  }
  input_error("PLUMB_ISA must be sse2, avx2 or avx512, got '{}'", text);
}

InstructionSet instruction_set() {
  if (const int set = forced.load(); set != kNotForced) return static_cast<InstructionSet>(set);
  static const InstructionSet chosen = [] {
    const char* text = std::getenv("PLUMB_ISA");
    return parse_instruction_set(text ? text : "");
  }();
  return chosen;
}

ForcedInstructionSet::ForcedInstructionSet(InstructionSet set) {
  require(processor_has(set), "this processor lacks {}", name_of(set));
  forced = static_cast<int>(set);
}
ForcedInstructionSet::~ForcedInstructionSet() { forced = kNotForced; }

}  // namespace plumb
