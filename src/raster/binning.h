// Which triangles meet which tile of the window, in the order of the mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh_runs.h"
#include "core/triangle_mesh.h"
#include "raster/clip.h"
#include "raster/fixed_point.h"
#include "raster/triangle_filter.h"
#include "raster/vertex_stage.h"

namespace plumb::raster {

/// The window cut into square tiles, row by row from the top left; the last ones may be smaller.
struct Tiling {
  int width_px = 0, height_px = 0, tile_px = 64;
  int columns = 0, rows = 0;

  std::size_t count() const { return static_cast<std::size_t>(columns) * rows; }
  PixelBox box(int column, int row) const;
};

Tiling make_tiling(int width_px, int height_px, int tile_px);

/// Everything that the stages after the vertices read.
struct Geometry {
  const TriangleMesh* mesh = nullptr;
  Projection projection;
  ScreenVertices vertices;            // those of runs in view
  std::vector<std::uint8_t> in_view;  // a run of the mesh each (MeshRuns); empty: all are

  /// Calls visit(first, last) for each stretch of triangles [first, last) that may be in view.
  template <class Visit>
  void for_each_stretch(std::uint32_t first, std::uint32_t last, const Visit& visit) const {
    if (in_view.empty()) return visit(first, last);
    constexpr std::uint32_t kRun = MeshRuns::kTriangles;
    for (std::uint32_t begin = first; begin < last;) {
      std::uint32_t end = std::min(last, (begin / kRun + 1) * kRun);
      const bool seen = in_view[begin / kRun] != 0;
      while (end < last && (in_view[end / kRun] != 0) == seen) end = std::min(last, end + kRun);
      if (seen) visit(begin, end);
      begin = end;
    }
  }
};

/// Which triangles are drawn, by the way that their corners run on the screen.
enum class Facing { Both, CounterClockwise, Clockwise };

/// What a triangle sends to a tile: itself, a piece of it, or the one fragment that it covers.
struct BinEntry {
  static constexpr std::uint32_t kWhole = 0xffffffff;

  std::uint32_t triangle = 0;
  std::uint32_t place = kWhole;  // a piece's index in Bins::pieces; a fragment's pixel in the image
  double depth_m = 0.0;          // a fragment's; 0 for what is still to be drawn

  bool is_fragment() const { return depth_m > 0.0; }
  bool is_piece() const { return !is_fragment() && place != kWhole; }
};

/// What to draw in each tile: entries [first[t], first[t + 1]) belong to tile t, in the order of
/// the triangles.
struct Bins {
  std::vector<std::size_t> first;
  std::vector<BinEntry> entries;
  std::vector<ClippedPiece> pieces;

  std::span<const BinEntry> of_tile(std::size_t tile) const {
    return {entries.data() + first[tile], first[tile + 1] - first[tile]};
  }
};

/// Sorts triangles into the tiles of the window, a chunk at a time so that memory stays bounded;
/// in parallel, with the same bins for any number of threads.
///
/// Left out are triangles that cover no pixel centre by their box, those of no area once snapped
/// and those that face the wrong way. A triangle that spans several tiles is entered where its edge
/// functions reach. With `fragments`, a whole triangle whose box holds one pixel is entered as the
/// fragment there, or not at all if that lies beyond the camera's far plane.
class Binner {
 public:
  Binner(const Geometry& geometry, const Tiling& tiling, Facing facing, bool fragments);
  /// The bins of triangles [first, first + count), valid until the next call. Throws
  /// std::invalid_argument if one of them names a vertex that the mesh does not have.
  const Bins& bin(std::uint32_t first, std::uint32_t count);

 private:
  struct Candidate {
    BinEntry entry;
    std::uint16_t column0, row0, column1, row1;  // of tiles
  };
  struct Block {  // of consecutive triangles, that one task takes
    std::vector<Candidate> candidates;
    std::vector<ClippedPiece> pieces;
    std::vector<std::uint32_t> kept;  // triangles that the filter leaves, from the block's first
    std::vector<std::size_t> places;  // by tile: how many entries; then, where the next one goes
    bool names_no_vertex = false;     // a triangle of it
  };

  void find_candidates(std::uint32_t first, std::uint32_t last, Block& block) const;
  void find_candidate(std::uint32_t triangle, Block& block) const;
  void clip(std::uint32_t triangle, Block& block) const;
  void add(const std::array<ScreenVertex, 3>& corners, BinEntry entry, Block& block) const;
  bool faces_rightly(std::int64_t signed_area) const;
  std::array<ScreenVertex, 3> corners_of(const Candidate& candidate, const Block& block) const;
  template <class Visit>
  void for_each_tile(const Candidate& candidate, const Block& block, const Visit& visit) const;
  void assign_places(std::size_t block_count);
  void fill(Block& block, std::uint32_t first_piece);

  const Geometry& geometry_;
  const Tiling& tiling_;
  Facing facing_;
  bool fragments_;
  TriangleFilter filter_;
  FilterTriangles filter_triangles_;
  std::vector<Block> blocks_;
  Bins bins_;
};

}  // namespace plumb::raster
