#include "reference/block_sides.h"

namespace plumb::reference {

void find_block_sides_sse2(const BlockView& view, BlockSides& sides);
void find_block_sides_avx2(const BlockView& view, BlockSides& sides);
void find_block_sides_avx512(const BlockView& view, BlockSides& sides);

FindBlockSides block_sides(InstructionSet set) {
  switch (set) {
    case InstructionSet::Sse2:
      return find_block_sides_sse2;
    case InstructionSet::Avx2:
      return find_block_sides_avx2;
    case InstructionSet::Avx512:
      return find_block_sides_avx512;
  }
  return find_block_sides_sse2;
}

}  // namespace plumb::reference
