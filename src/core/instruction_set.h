// Which of the processor's vector instructions the fast kernels use.
#pragma once

#include <string>
#include <vector>

namespace plumb {

/// In ascending order; each includes those before it. Every kernel gives the same bits.
enum class InstructionSet { Sse2, Avx2, Avx512 };

const char* name_of(InstructionSet set);  // "sse2", "avx2", "avx512"

/// Those that this processor has.
std::vector<InstructionSet> available_instruction_sets();

/// The one that kernels use: the last one available, or the one that the environment variable
/// PLUMB_ISA names. Read once. Throws InputError if PLUMB_ISA names none, or one that this
/// processor lacks.
InstructionSet instruction_set();

/// Which of a kernel's three versions is for `set`.
template <class Kernel>
Kernel kernel_for(InstructionSet set, Kernel sse2, Kernel avx2, Kernel avx512) {
  return set == InstructionSet::Avx512 ? avx512 : set == InstructionSet::Avx2 ? avx2 : sse2;
}

/// While it lives, kernels use `set`. For tests, one at a time; `set` must be available.
class ForcedInstructionSet {
 public:
  explicit ForcedInstructionSet(InstructionSet set);
  ~ForcedInstructionSet();
  ForcedInstructionSet(const ForcedInstructionSet&) = delete;
  ForcedInstructionSet& operator=(const ForcedInstructionSet&) = delete;
};

/// As PLUMB_ISA is read; an empty text stands for the best. Throws as instruction_set() does.
InstructionSet parse_instruction_set(const std::string& text);

}  // namespace plumb
