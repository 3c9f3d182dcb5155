// Terrain as stacks: over each grid point an ordered list of layers of material.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "terrain/heightfield.h"

namespace plumb::terrain {

/// Index of a material in StackField::materials.
using Material = std::uint8_t;
inline constexpr Material kAir = 0;

struct MaterialInfo {
  std::string name;
  glm::dvec3 colour{0.5};  // linear

  friend bool operator==(const MaterialInfo&, const MaterialInfo&) = default;
};

/// One stack, from the bottom up: layer k reaches from the end of layer k - 1 (layer 0 from low_m)
/// to end_m[k]; above the last layer is air.
struct StackView {
  float low_m = 0.0F;
  std::span<const float> end_m;
  std::span<const Material> material;

  std::size_t size() const { return end_m.size(); }
  float start_m(std::size_t k) const { return k == 0 ? low_m : end_m[k - 1]; }
  /// Of what fills the stack there, the end of a layer belonging to the layer above it.
  Material at(float height_m) const;
};

/// Stacks on a regular grid, in flat arrays. Stack (i, j) stands at origin_m + (i * dx_m, j *
/// dy_m); i runs east, j runs north; heights are world heights in metres.
///
/// Each stack covers [low_m, high_m()] with layers whose ends rise strictly above low_m and lie at
/// or below high_m(); neighbouring layers differ in material, the last one is not air (so that a
/// stack of air has no layer, and one of a heightfield has one). Below low_m its lowest layer goes
/// on, above high_m() is air. A hole is a stack of which nothing is known: no layers, marked.
///
/// As a volume it has `voxels` voxels up, each voxel_m high: the lattice of dual contouring. Voxel
/// v reaches from low_m + v * voxel_m to low_m + (v + 1) * voxel_m.
///
/// Source: [Löffler et al. 2011, section 3]; layers as [Beneš & Forsbach 2001].
struct StackField {
  int columns = 0, rows = 0;
  double dx_m = 1.0, dy_m = 1.0, voxel_m = 1.0;
  glm::dvec2 origin_m{0.0};
  float low_m = 0.0F;
  int voxels = 1;                                // >= 1
  std::vector<std::uint32_t> first_layer = {0};  // columns * rows + 1 entries: of each stack
  std::vector<float> end_m;                      // of each layer
  std::vector<Material> material;                // of each layer
  std::vector<std::uint8_t> holes;      // columns * rows, 1 is a hole; empty where there is none
  std::vector<MaterialInfo> materials;  // the first is air; at most 256
  Provenance provenance;

  double high_m() const { return static_cast<double>(low_m) + voxels * voxel_m; }
  /// The highest float that is not above high_m(): the highest end that a layer may have.
  float highest_m() const;
  std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(i);
  }
  bool is_hole(int i, int j) const { return !holes.empty() && holes[index(i, j)] != 0; }
  StackView stack(int i, int j) const;
  /// Of the arrays: what the stacks take in memory.
  std::size_t bytes() const;
};

/// A layer as it is given: anything from start to end.
struct Layer {
  float start_m = 0.0F, end_m = 0.0F;
  Material material = kAir;

  friend bool operator==(const Layer&, const Layer&) = default;
};

/// Fills a field's stacks in the order of its arrays: row by row, each from west to east.
class StackWriter {
 public:
  /// `field` has its sizes, its spacing and its heights; its arrays are emptied.
  explicit StackWriter(StackField& field);

  /// Layers from the bottom up; gaps are air. Layers without thickness are left out, equal
  /// neighbours joined, and what lies outside [low_m, high_m()] is cut off.
  /// Throws std::invalid_argument for a layer that ends below its start, overlaps the one before,
  /// is not finite or of a material that the field does not have, or beyond the last stack; the
  /// field then is as it was.
  void add(std::span<const Layer> layers);
  void add_hole();

 private:
  void require_room() const;
  void put(std::size_t first, float end_m, Material material);
  void next();

  StackField& field_;
};

/// All layers of a stack with the air between them, from low_m to high_m: what covers every height.
std::vector<Layer> layers_of(const StackField& field, int i, int j);

/// A heightfield as stacks of one layer of rock; voids are holes.
///
/// voxel_m  height of a voxel, >= 0; 0: the mean of dx and dy, so that voxels are cubes where the
///          grid is square
/// returns  low_m lies one voxel or more below the lowest height, on a whole multiple of voxel_m
///          (on the next float below it, where it is none), high_m() above the highest
/// Throws InputError for a terrain without a height, or of more than 2^31 - 1 voxels up;
/// std::invalid_argument for a voxel_m below zero or not finite.
StackField stacks_of(const Heightfield& field, double voxel_m = 0.0);

/// The end of each stack's highest layer, low_m where it is all air, NaN at holes; provenance says
/// so.
Heightfield top_surface(const StackField& field);

/// Checksum of sizes, spacing, origin, layers and materials: two fields with the same one are the
/// same.
std::uint64_t checksum(const StackField& field);

/// Throws std::invalid_argument unless the field is as StackField says.
void require_valid(const StackField& field);

}  // namespace plumb::terrain
