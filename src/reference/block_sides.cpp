#include "reference/block_sides.h"

namespace plumb::reference {

void find_block_sides_sse2(const BlockView& view, BlockSides& sides);
void find_block_sides_avx2(const BlockView& view, BlockSides& sides);
void find_block_sides_avx512(const BlockView& view, BlockSides& sides);

FindBlockSides block_sides(InstructionSet set) {
  return kernel_for(set, find_block_sides_sse2, find_block_sides_avx2, find_block_sides_avx512);
}

}  // namespace plumb::reference
