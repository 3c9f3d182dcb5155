#include "core/lanes_avx512.h"
#include "reference/block_sides_kernel.h"

namespace plumb::reference {

void find_block_sides_avx512(const BlockView& view, BlockSides& sides) {
  find_block_sides<Avx512Lanes>(view, sides);
}

}  // namespace plumb::reference
