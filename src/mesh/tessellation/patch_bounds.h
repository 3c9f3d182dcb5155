// How far a patch and each of its blocks lie from the full detail when drawn thinned.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/grid.h"
#include "mesh/patch_quadtree/patch_layout.h"
#include "mesh/patch_quadtree/patch_numbers.h"
#include "mesh/tessellation/block_pieces.h"
#include "mesh/tessellation/bound_scale.h"
#include "mesh/tessellation/mixture_deviation.h"

namespace plumb::mesh::tessellation {

/// What is known of a patch without its heights.
///
/// A block's bound of thinning d holds for every mixture that is drawn with its inside thinned by
/// 2^d and no side by more: the largest vertical distance between what is drawn, on decoded
/// heights, and the full-detail surface (`blocks:8`), at the samples and wherever edges of the two
/// cross. No bound (BoundScale::kNone) where thinning would change the outline of a void.
struct PatchBounds {
  float low_m = 0.0f, high_m = -1.0f;  // of the finest heights beneath; low > high: all void
  float published_m = 0.0f;            // the paper's Err_appr, without delta
  int blocks = 0, levels = 0;          // blocks along a side, thinnings of a block
  std::vector<std::uint8_t> codes;     // block by block, row by row, `levels` each; empty: all void

  bool is_void() const { return codes.empty(); }
  std::uint8_t code(int i, int j, int level) const {
    return codes[(static_cast<std::size_t>(j) * static_cast<std::size_t>(blocks) +
                  static_cast<std::size_t>(i)) *
                     static_cast<std::size_t>(levels) +
                 static_cast<std::size_t>(level)];
  }
  /// Err(P): the largest of its blocks' bounds at full detail.
  std::uint8_t error_code() const;

  friend bool operator==(const PatchBounds&, const PatchBounds&) = default;
};

/// Measures patches of one level. The heights are the terrain's finest and outlive it.
class BoundsOfLevel {
 public:
  BoundsOfLevel(const Grid<float>& heights_m, const patch_quadtree::PatchLayout& layout, int level,
                const BlockPieces& pieces, const BoundScale& scale);

  /// decoded_m: (n + 3)^2 heights of the patch as a decoder gives them. `published_m` is left
  /// alone.
  PatchBounds bounds(const patch_quadtree::PatchPlace& patch, const Grid<float>& decoded_m) const;

 private:
  struct Beneath {
    float low_m, high_m;
    bool some_void, some_height;
  };

  BlockPlaces places_of(const patch_quadtree::PatchPlace& patch, int i, int j) const;
  Beneath beneath(const BlockPlaces& places) const;
  void measure(const MixtureDeviation& blocks, const std::vector<double>& drawn_m,
               const TruthBelow& truth, std::uint8_t* codes) const;
  double error_of_samples(const BlockPlaces& places, const std::vector<double>& drawn_m) const;

  const Grid<float>& heights_m_;
  patch_quadtree::PatchLayout layout_;
  int level_;
  const BlockPieces& pieces_;
  BoundScale scale_;
  std::array<std::optional<MixtureDeviation>, kBlockShapes> shapes_;
};

}  // namespace plumb::mesh::tessellation
