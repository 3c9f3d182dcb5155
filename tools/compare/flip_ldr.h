// The part of FLIP that both kinds share.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "compare/flip.h"
#include "compare/flip_filters.h"
#include "compare/flip_kernels.h"

namespace plumb::compare {

/// Throws as flip_ldr does; `name` says which picture.
void require_usable(const ColourPlanes& picture, const char* name);
void require_same_size(const ColourPlanes& reference, const ColourPlanes& candidate);

/// A picture's opponent colours, rows of `stride` floats of which the first `width_px` are pixels.
struct OpponentPlanes {
  int width_px, height_px, stride;
  std::array<std::unique_ptr<float[]>, 3> plane;

  OpponentPlanes(int width, int height);
  float* row(int p, int y) { return plane[p].get() + static_cast<std::size_t>(y) * stride; }
  const float* row(int p, int y) const {
    return plane[p].get() + static_cast<std::size_t>(y) * stride;
  }
};

/// Makes count values a row linear and cuts them to 0..1, in place.
using MakeLinear = std::function<void(int count, float* const rgb[3])>;

void fill(OpponentPlanes& planes, const ColourPlanes& picture, const FlipKernels& kernels,
          const MakeLinear& make_linear);

/// error[y * width + x] from two filled pictures of one size.
void flip_errors(const OpponentPlanes& reference, const OpponentPlanes& candidate,
                 const FlipFilters& filters, const FlipKernels& kernels, std::vector<float>& error);

}  // namespace plumb::compare
