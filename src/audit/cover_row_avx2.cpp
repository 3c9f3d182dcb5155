#include "audit/cover_row_kernel.h"
#include "core/lanes_avx2.h"

namespace plumb::audit {

double cover_samples_avx2(const CoverTriangle& triangle, const CoverRow& row, int first, int last) {
  return cover_samples_of<Avx2Lanes>(triangle, row, first, last);
}

}  // namespace plumb::audit
