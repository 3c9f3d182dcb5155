#include "core/lanes_avx2.h"
#include "reference/block_sides_kernel.h"

namespace plumb::reference {

void find_block_sides_avx2(const BlockView& view, BlockSides& sides) {
  find_block_sides<Avx2Lanes>(view, sides);
}

}  // namespace plumb::reference
