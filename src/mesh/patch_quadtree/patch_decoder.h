// Patches out of a container.
#pragma once

#include <functional>
#include <optional>

#include "core/grid.h"
#include "mesh/patch_quadtree/container.h"
#include "mesh/patch_quadtree/modelled_patch.h"
#include "mesh/patch_quadtree/patch_numbers.h"
#include "mesh/patch_quadtree/published_family.h"

namespace plumb::mesh::patch_quadtree {

/// Decodes what a container holds, from any thread. Keeps a reference to it.
///
/// Every function throws InputError, one line with the file and the patch, where bytes are no
/// patch's; damage that no checksum and no coder tells gives other heights, never anything else.
class PatchDecoder {
 public:
  explicit PatchDecoder(const Container& container);

  const ContainerHeader& header() const { return container_.header(); }
  /// A patch's numbers, by way of its ancestors.
  PatchNumbers numbers(const PatchPlace& patch) const;
  /// The same of one whose parent is at hand.
  PatchNumbers numbers(const PatchPlace& patch, const PatchNumbers& parent) const;
  /// All children of a patch above level 0 that lie on the terrain: version 1 decodes them at once.
  Family children(const PatchPlace& patch, const PatchNumbers& numbers) const;
  /// (n + 3) x (n + 3) heights, NaN for voids.
  Grid<float> heights(const PatchPlace& patch) const;

  /// Calls body(place, numbers) once for every patch of a level and of those above it, in any order
  /// and on any thread; each is decoded once, and few are there at a time.
  void visit(int level,
             const std::function<void(const PatchPlace&, const PatchNumbers&)>& body) const;
  /// All samples of a level, on all threads: sample (i, j) of the grid stands at the terrain's
  /// column min(i 2^level, last) and row likewise. Throws InputError if they do not fit into
  /// memory.
  Grid<float> level_heights(int level) const;

 private:
  PatchNumbers root() const;
  void require_level(int level) const;
  [[noreturn]] void damaged(const PatchPlace& patch) const;

  const Container& container_;
  std::optional<ModelTables> tables_;  // of version 2
};

}  // namespace plumb::mesh::patch_quadtree
