// Patches of a compressed quadtree, each cut into blocks that a tessellator refines.
#pragma once

#include <filesystem>
#include <memory>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "mesh/patch_quadtree/container.h"
#include "mesh/patch_quadtree/patch_decoder.h"
#include "mesh/tessellation/block_errors.h"
#include "mesh/tessellation/block_pieces.h"
#include "mesh/tessellation/build.h"
#include "mesh/tessellation/parameters.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::tessellation {

/// What does not depend on the view: a coded terrain, as a file or in memory, and its bounds.
/// Heights are decoded for each frame, those that it draws and their ancestors'.
struct Prepared {
  Parameters parameters;
  std::shared_ptr<const patch_quadtree::Container> container;
  std::shared_ptr<const patch_quadtree::PatchDecoder> decoder;  // of the container
  std::shared_ptr<const Bounds> bounds;
  std::shared_ptr<const BlockPieces> pieces;
  std::shared_ptr<const ThinnedForetold> foretold;    // of the pieces
  std::shared_ptr<const BlockPieces> truth_pieces;    // of blocks of 8, as the full detail has them
  std::shared_ptr<const BlockGeometries> geometries;  // of blocks over their patch's samples

  const patch_quadtree::ContainerHeader& header() const { return container->header(); }
};

/// Builds the file in memory. Throws as `build` does.
Prepared prepare(const terrain::Heightfield& field, const Parameters& parameters = {});

/// Draws from a file that was built from this terrain: error, patches and blocks are the file's.
/// Throws InputError if it cannot be read, is damaged, or was built from another terrain.
Prepared prepare(const terrain::Heightfield& field, const std::filesystem::path& file,
                 const Parameters& parameters = {});

/// The patches that the view asks for, tessellated block by block, with skirts.
///
/// Variant `conservative`:
///   (1) In metres: the drawn surface lies within the tolerance of the full-detail one (diagonals
///   `blocks:8`), at every sample and between them; the camera is not used but to say how many
///   patches are in view. (2) In pixels: what is in view is displaced on screen by at most the
///   tolerance. (3) Where the coded heights are too coarse for either, the claim says what holds
///   instead, and that it is out of reach. (4) Its outline, voids included, is that of the
///   full-detail surface. (5) Blocks agree on the sides they share; where patches of two levels
///   meet, walls fill what is between them.
/// Variant `published` selects as the paper prints it, less what is mended.
/// Source: [Yusov & Shevtsov 2011]; departures are named in docs/algorithms/tessellation.md.
DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance);

}  // namespace plumb::mesh::tessellation
