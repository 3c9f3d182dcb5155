// What a user sets of the method.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb::mesh::tessellation {

enum class Variant { Conservative, Published };

/// Why the published rules break their promise; each can be mended alone.
enum class Cause : std::size_t {
  /// One point stands for a whole edge. Mended: the box of the blocks on either side of it.
  EdgeMidpoint,
  /// A vertical length seen from above is short where it is tested. Mended: it counts as if seen
  /// from the side, its own length at its depth; off the middle of a wide view or deep within the
  /// box it may reach farther still, so that this is a better test and no upper bound.
  ViewFromAbove,
  /// A coarser thinning passes where a finer one does not. Mended: the finer ones must pass too.
  NotMonotone,
  /// A block's error belongs to one factor, its sides have others. Mended: the largest of any
  /// mixture, between the samples too.
  MixedFactors,
  /// The most tolerant side decides the inside. Mended: the least tolerant does.
  InnerMinimum,
  /// gamma Err / rho is no upper bound. Mended: what displaces nothing in the box by more.
  DistanceTest,
  /// Err_int of bilinear patches, drawn as triangles. Mended: the error as drawn.
  BilinearError,
};
inline constexpr std::size_t kCauses = 7;

const char* name_of(Cause cause);  // "edge-midpoint", ...

/// What is mended of the published rules.
using Mends = std::array<bool, kCauses>;

struct Parameters {
  Variant variant = Variant::Conservative;
  double error_m = 0.0;   // of the coded heights; 0: next to none
  int patch_cells = 128;  // a power of two from 8 to 1024
  int block_cells = 8;    // a power of two from 8 to 64, at most patch_cells
  std::uint32_t format_version = 2;
  Mends mends{};               // of the published variant
  bool fine_selection = true;  // false: every block in full, chunked level of detail
};

}  // namespace plumb::mesh::tessellation
