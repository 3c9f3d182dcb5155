#include "raster/binning.h"

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"
#include "raster/perspective.h"

namespace plumb::raster {
namespace {

constexpr std::uint32_t kBlock = 8192;      // triangles
constexpr std::uint32_t kMostTogether = 8;  // that a filter looks at

std::array<glm::dvec3, 3> corners_from_eye(const Geometry& geometry, const Triangle& triangle) {
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = geometry.projection.from_eye(geometry.mesh->vertices_m[triangle[i]]);
  }
  return corners;
}

}  // namespace

Binner::Binner(const Geometry& geometry, const Tiling& tiling, Facing facing, bool fragments)
    : geometry_(geometry),
      tiling_(tiling),
      facing_(facing),
      fragments_(fragments),
      filter_{geometry.vertices.data(), geometry.vertices.size(), kClipped, tiling.width_px - 1,
              tiling.height_px - 1},
      filter_triangles_(filter_triangles(instruction_set())) {}

PixelBox Tiling::box(int column, int row) const {
  return {column * tile_px, row * tile_px, std::min((column + 1) * tile_px, width_px) - 1,
          std::min((row + 1) * tile_px, height_px) - 1};
}

Tiling make_tiling(int width_px, int height_px, int tile_px) {
  return {width_px, height_px, tile_px, (width_px + tile_px - 1) / tile_px,
          (height_px + tile_px - 1) / tile_px};
}

bool Binner::faces_rightly(std::int64_t signed_area) const {
  return facing_ == Facing::Both || (signed_area > 0) == (facing_ == Facing::Clockwise);
}

void Binner::add(const std::array<ScreenVertex, 3>& corners, BinEntry entry, Block& block) const {
  const PixelBox window{0, 0, tiling_.width_px - 1, tiling_.height_px - 1};
  const PixelBox box = common_part(pixel_box(corners[0], corners[1], corners[2]), window);
  const std::int64_t area = doubled_area(corners[0], corners[1], corners[2]);
  if (box.empty() || area == 0 || !faces_rightly(area)) return;
  if (box.holds_one_pixel()) {  // most triangles of a dense mesh end here
    const EdgeFunctions edges = edge_functions(corners);
    if (!may_cover(edges, box)) return;
    if (fragments_ && !entry.is_piece()) {
      const glm::dvec3 scales = corner_scales(edges, corners);
      entry.depth_m = depth_of(corner_shares(edges, scales, box.x0, box.y0));
      if (entry.depth_m > geometry_.projection.camera.far_m) return;
      entry.place = static_cast<std::uint32_t>(box.y0) * static_cast<std::uint32_t>(window.x1 + 1) +
                    static_cast<std::uint32_t>(box.x0);
    }
  }
  const auto tile_of = [this](int px) { return static_cast<std::uint16_t>(px / tiling_.tile_px); };
  block.candidates.push_back(
      {entry, tile_of(box.x0), tile_of(box.y0), tile_of(box.x1), tile_of(box.y1)});
}

void Binner::clip(std::uint32_t triangle, Block& block) const {
  std::array<ClippedPiece, kMostPieces> pieces;
  const int count =
      clip_triangle(geometry_.projection,
                    corners_from_eye(geometry_, geometry_.mesh->triangles[triangle]), pieces);
  for (int k = 0; k < count; ++k) {
    const ClippedPiece& piece = pieces[static_cast<std::size_t>(k)];
    const std::size_t before = block.candidates.size();
    add(piece.corners, {triangle, static_cast<std::uint32_t>(block.pieces.size())}, block);
    if (block.candidates.size() > before) block.pieces.push_back(piece);
  }
}

void Binner::find_candidates(std::uint32_t first, std::uint32_t last, Block& block) const {
  block.candidates.clear();
  block.pieces.clear();
  block.names_no_vertex = false;
  if (first == last) return;
  block.kept.resize(kBlock + kMostTogether);
  geometry_.for_each_stretch(first, last, [&](std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t count = filter_triangles_(filter_, geometry_.mesh->triangles[begin].data(),
                                                  end - begin, block.kept.data());
    if (count == kBadIndex) {
      block.names_no_vertex = true;
      return;
    }
    for (std::uint32_t k = 0; k < count; ++k) find_candidate(begin + block.kept[k], block);
  });
}

void Binner::find_candidate(std::uint32_t triangle, Block& block) const {
  const Triangle& corners = geometry_.mesh->triangles[triangle];
  const ScreenVertex& a = geometry_.vertices[corners[0]];
  const ScreenVertex& b = geometry_.vertices[corners[1]];
  const ScreenVertex& c = geometry_.vertices[corners[2]];
  if (a.x != kClipped && b.x != kClipped && c.x != kClipped) {
    add({a, b, c}, {triangle}, block);
  } else {
    clip(triangle, block);
  }
}

std::array<ScreenVertex, 3> Binner::corners_of(const Candidate& candidate,
                                               const Block& block) const {
  if (candidate.entry.is_piece()) return block.pieces[candidate.entry.place].corners;
  const Triangle& corners = geometry_.mesh->triangles[candidate.entry.triangle];
  return {geometry_.vertices[corners[0]], geometry_.vertices[corners[1]],
          geometry_.vertices[corners[2]]};
}

template <class Visit>
void Binner::for_each_tile(const Candidate& candidate, const Block& block,
                           const Visit& visit) const {
  const auto tile = [&](int column, int row) {
    return static_cast<std::size_t>(row) * tiling_.columns + column;
  };
  if (candidate.column0 == candidate.column1 && candidate.row0 == candidate.row1) {
    visit(tile(candidate.column0, candidate.row0));
    return;
  }
  const EdgeFunctions edges = edge_functions(corners_of(candidate, block));
  for (int row = candidate.row0; row <= candidate.row1; ++row) {
    for (int column = candidate.column0; column <= candidate.column1; ++column) {
      if (may_cover(edges, tiling_.box(column, row))) visit(tile(column, row));
    }
  }
}

// From counts by block and tile to the places of the entries: tile by tile, within a tile block by
// block, so that the order is that of the mesh.
void Binner::assign_places(std::size_t block_count) {
  bins_.first.resize(tiling_.count() + 1);
  std::size_t next = 0;
  for (std::size_t tile = 0; tile < tiling_.count(); ++tile) {
    bins_.first[tile] = next;
    for (std::size_t b = 0; b < block_count; ++b) {
      const std::size_t count = blocks_[b].places[tile];
      blocks_[b].places[tile] = next;
      next += count;
    }
  }
  bins_.first[tiling_.count()] = next;
  bins_.entries.resize(next);
}

void Binner::fill(Block& block, std::uint32_t first_piece) {
  for (const Candidate& candidate : block.candidates) {
    BinEntry entry = candidate.entry;
    if (entry.is_piece()) entry.place += first_piece;
    for_each_tile(candidate, block,
                  [&](std::size_t tile) { bins_.entries[block.places[tile]++] = entry; });
  }
}

const Bins& Binner::bin(std::uint32_t first, std::uint32_t count) {
  const std::size_t block_count = (std::size_t{count} + kBlock - 1) / kBlock;
  if (blocks_.size() < block_count) blocks_.resize(block_count);
  parallel_for(static_cast<std::int64_t>(block_count), 1, [&](std::int64_t b) {
    Block& block = blocks_[static_cast<std::size_t>(b)];
    const std::uint32_t begin = static_cast<std::uint32_t>(b) * kBlock;
    find_candidates(first + begin, first + std::min(begin + kBlock, count), block);
    block.places.assign(tiling_.count(), 0);
    for (const Candidate& candidate : block.candidates) {
      for_each_tile(candidate, block, [&](std::size_t tile) { ++block.places[tile]; });
    }
  });
  for (std::size_t b = 0; b < block_count; ++b) {
    require(!blocks_[b].names_no_vertex, "a triangle names a vertex that the mesh does not have");
  }
  assign_places(block_count);

  std::vector<std::uint32_t> first_piece(block_count);
  bins_.pieces.clear();
  for (std::size_t b = 0; b < block_count; ++b) {
    first_piece[b] = static_cast<std::uint32_t>(bins_.pieces.size());
    bins_.pieces.insert(bins_.pieces.end(), blocks_[b].pieces.begin(), blocks_[b].pieces.end());
  }
  parallel_for(static_cast<std::int64_t>(block_count), 1, [&](std::int64_t b) {
    fill(blocks_[static_cast<std::size_t>(b)], first_piece[static_cast<std::size_t>(b)]);
  });
  return bins_;
}

}  // namespace plumb::raster
