#include "core/lanes_sse2.h"
#include "reference/block_sides_kernel.h"

namespace plumb::reference {

void find_block_sides_sse2(const BlockView& view, BlockSides& sides) {
  find_block_sides<Sse2Lanes>(view, sides);
}

}  // namespace plumb::reference
