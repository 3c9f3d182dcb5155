#include "audit/cover_row.h"

namespace plumb::audit {

double cover_samples_sse2(const CoverTriangle& triangle, const CoverRow& row, int first, int last);
double cover_samples_avx2(const CoverTriangle& triangle, const CoverRow& row, int first, int last);
double cover_samples_avx512(const CoverTriangle& triangle, const CoverRow& row, int first,
                            int last);

CoverSamples cover_samples(InstructionSet set) {
  return kernel_for(set, cover_samples_sse2, cover_samples_avx2, cover_samples_avx512);
}

}  // namespace plumb::audit
