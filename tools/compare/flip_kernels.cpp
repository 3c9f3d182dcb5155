#include "compare/flip_kernels.h"

namespace plumb::compare {

extern const FlipKernels kFlipKernelsSse2;
extern const FlipKernels kFlipKernelsAvx2;
extern const FlipKernels kFlipKernelsAvx512;

const FlipKernels& flip_kernels(InstructionSet set) {
  return *kernel_for(set, &kFlipKernelsSse2, &kFlipKernelsAvx2, &kFlipKernelsAvx512);
}

}  // namespace plumb::compare
