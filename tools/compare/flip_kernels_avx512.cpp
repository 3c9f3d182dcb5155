#include "compare/flip_filter_body.h"
#include "compare/flip_lanes_avx512.h"
#include "compare/flip_pixel_body.h"

namespace plumb::compare {

extern const FlipKernels kFlipKernelsAvx512;
const FlipKernels kFlipKernelsAvx512{
    PixelKernels<Avx512Floats>::linearise,        PixelKernels<Avx512Floats>::expose,
    PixelKernels<Avx512Floats>::to_opponent,      FilterKernels<Avx512Floats>::filter_down,
    FilterKernels<Avx512Floats>::filter_across,   PixelKernels<Avx512Floats>::to_hunt_lab,
    PixelKernels<Avx512Floats>::differ_in_colour, PixelKernels<Avx512Floats>::differ_in_features,
    PixelKernels<Avx512Floats>::combine};

}  // namespace plumb::compare
