#include "audit/cover_row_kernel.h"
#include "core/lanes_sse2.h"

namespace plumb::audit {

double cover_samples_sse2(const CoverTriangle& triangle, const CoverRow& row, int first, int last) {
  return cover_samples_of<Sse2Lanes>(triangle, row, first, last);
}

}  // namespace plumb::audit
