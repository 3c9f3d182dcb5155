#include "compare/flip_filter_body.h"
#include "compare/flip_lanes_sse2.h"
#include "compare/flip_pixel_body.h"

namespace plumb::compare {

extern const FlipKernels kFlipKernelsSse2;
const FlipKernels kFlipKernelsSse2{
    PixelKernels<Sse2Floats>::linearise,        PixelKernels<Sse2Floats>::expose,
    PixelKernels<Sse2Floats>::to_opponent,      FilterKernels<Sse2Floats>::filter_down,
    FilterKernels<Sse2Floats>::filter_across,   PixelKernels<Sse2Floats>::to_hunt_lab,
    PixelKernels<Sse2Floats>::differ_in_colour, PixelKernels<Sse2Floats>::differ_in_features,
    PixelKernels<Sse2Floats>::combine};

}  // namespace plumb::compare
