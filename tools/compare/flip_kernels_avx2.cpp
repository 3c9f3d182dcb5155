#include "compare/flip_filter_body.h"
#include "compare/flip_lanes_avx2.h"
#include "compare/flip_pixel_body.h"

namespace plumb::compare {

extern const FlipKernels kFlipKernelsAvx2;
const FlipKernels kFlipKernelsAvx2{
    PixelKernels<Avx2Floats>::linearise,        PixelKernels<Avx2Floats>::expose,
    PixelKernels<Avx2Floats>::to_opponent,      FilterKernels<Avx2Floats>::filter_down,
    FilterKernels<Avx2Floats>::filter_across,   PixelKernels<Avx2Floats>::to_hunt_lab,
    PixelKernels<Avx2Floats>::differ_in_colour, PixelKernels<Avx2Floats>::differ_in_features,
    PixelKernels<Avx2Floats>::combine};

}  // namespace plumb::compare
