#include "audit/cover_row_kernel.h"
#include "core/lanes_avx512.h"

namespace plumb::audit {

double cover_samples_avx512(const CoverTriangle& triangle, const CoverRow& row, int first,
                            int last) {
  return cover_samples_of<Avx512Lanes>(triangle, row, first, last);
}

}  // namespace plumb::audit
