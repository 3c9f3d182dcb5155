// A terrain as a quadtree of patches: every level keeps every second sample of the finer one.
#pragma once

#include <cstdint>

namespace plumb::mesh::patch_quadtree {

/// A patch: column px, row py of its level; level 0 is the finest.
struct PatchPlace {
  int level = 0, px = 0, py = 0;

  PatchPlace parent() const { return {level + 1, px / 2, py / 2}; }
  /// Child (s, t) of the next finer level, s and t in {0, 1}; it may lie beyond the terrain.
  PatchPlace child(int s, int t) const { return {level - 1, 2 * px + s, 2 * py + t}; }

  friend bool operator==(const PatchPlace&, const PatchPlace&) = default;
};

/// Patches of n x n cells, n = patch_cells, whose samples (i, j), i and j from -1 to n + 1, stand
/// at the terrain's columns and rows (px n + i) 2^level; neighbours share their border samples, and
/// have one row and column beyond it in common, for normals. A place beyond the terrain is that of
/// its last column or row: outlines stay, cells there are narrower or nothing.
struct PatchLayout {
  int columns = 0, rows = 0;  // samples of the terrain
  int patch_cells = 128;
  int levels = 1;  // the last one has a single patch

  /// Samples along a side of a patch with its margin: n + 3.
  int side() const { return patch_cells + 3; }
  int patch_columns(int level) const { return patches_along(columns, level); }
  int patch_rows(int level) const { return patches_along(rows, level); }
  bool contains(const PatchPlace& patch) const {
    return patch.level >= 0 && patch.level < levels && patch.px >= 0 && patch.py >= 0 &&
           patch.px < patch_columns(patch.level) && patch.py < patch_rows(patch.level);
  }
  PatchPlace root() const { return {levels - 1, 0, 0}; }

  /// Patches of all levels; they are numbered from the root down, each level row by row.
  std::int64_t patch_count() const { return first_of_level(-1); }
  std::int64_t index(const PatchPlace& patch) const {
    return first_of_level(patch.level) +
           static_cast<std::int64_t>(patch.py) * patch_columns(patch.level) + patch.px;
  }
  PatchPlace place(std::int64_t index) const;
  /// Number of the first patch of a level; of level -1: of all patches.
  std::int64_t first_of_level(int level) const;

  /// The terrain's column of a patch's sample i in [-1, n + 1]; likewise its row.
  int sample_column(const PatchPlace& patch, int i) const {
    return place_along(columns, patch.px, patch.level, i);
  }
  int sample_row(const PatchPlace& patch, int j) const {
    return place_along(rows, patch.py, patch.level, j);
  }

 private:
  int patches_along(int samples, int level) const {
    const std::int64_t cells = static_cast<std::int64_t>(patch_cells) << level;
    return static_cast<int>((std::int64_t{samples} - 1 + cells - 1) / cells);
  }
  int place_along(int samples, int patch, int level, int at) const {
    const std::int64_t place =
        (static_cast<std::int64_t>(patch) * patch_cells + at) * (std::int64_t{1} << level);
    return static_cast<int>(place < 0 ? 0 : place > samples - 1 ? samples - 1 : place);
  }
};

/// The layout of a terrain of at least 2 x 2 samples, down to a level of one patch.
/// Throws std::invalid_argument unless patch_cells is a power of two from 8 to 1024.
PatchLayout layout_of(int columns, int rows, int patch_cells);

}  // namespace plumb::mesh::patch_quadtree
