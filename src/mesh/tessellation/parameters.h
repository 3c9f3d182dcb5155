// What a user sets of the method.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb::mesh::tessellation {

enum class Variant { Conservative, Published };

/// Why the published rules break their promise; each can be mended alone.
enum class Cause : std::size_t {
  EdgeMidpoint,   // one point stands for a whole edge
  ViewFromAbove,  // a vertical length seen from above is short where it is tested
  NotMonotone,    // a coarser thinning passes where a finer one does not
  MixedFactors,   // a block's error belongs to one factor, its sides have others
  InnerMinimum,   // the most tolerant side decides the inside
  DistanceTest,   // gamma Err / rho is no upper bound
  BilinearError,  // Err_int of bilinear patches, drawn as triangles
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
