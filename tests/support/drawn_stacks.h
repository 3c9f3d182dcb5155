// Stacks for tests: written as letters, or drawn at random.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "terrain/stacks/stack_field.h"

namespace plumb::test_support {

/// A field of `columns` stacks a row, all of which are still to be written; air, rock, sand and
/// lime, voxels of a metre.
inline terrain::StackField empty_stacks(int columns, int rows, int high_m) {
  terrain::StackField field;
  field.columns = columns;
  field.rows = rows;
  field.voxels = high_m;
  field.materials = {{"air", glm::dvec3(0.0)}, {"rock"}, {"sand"}, {"lime"}, {"clay"}};
  return field;
}

inline terrain::Material material_of(char letter) {
  return static_cast<terrain::Material>(std::string(".rslc").find(letter));
}

/// Stacks from 0 m up, one letter a metre from the bottom to the top: '.' air, 'r' rock, 's' sand,
/// 'l' lime; an empty text is a hole.
inline terrain::StackField written_stacks(int columns, const std::vector<std::string>& stacks) {
  std::size_t high_m = 1;
  for (const std::string& stack : stacks) high_m = std::max(high_m, stack.size());
  terrain::StackField field =
      empty_stacks(columns, static_cast<int>(stacks.size()) / columns, static_cast<int>(high_m));
  terrain::StackWriter writer(field);
  for (const std::string& stack : stacks) {
    if (stack.empty()) {
      writer.add_hole();
      continue;
    }
    std::vector<terrain::Layer> layers;
    for (std::size_t k = 0; k < stack.size(); ++k)
      layers.push_back({static_cast<float>(k), static_cast<float>(k + 1), material_of(stack[k])});
    writer.add(layers);
  }
  return field;
}

/// Whole numbers from a written seed, the same everywhere.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : generator_(seed) {}
  /// In [low, high].
  int whole(int low, int high) {
    return low + static_cast<int>(generator_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 generator_;
};

/// Layers from 0 to high_m of the first `materials` materials, their ends on quarters of a metre:
/// up to `most` of them, air among them as any other.
inline std::vector<terrain::Layer> drawn_layers(Draws& draws, int high_m, int materials, int most) {
  std::vector<int> ends;
  for (int k = draws.whole(0, most - 1); k > 0; --k) ends.push_back(draws.whole(1, 4 * high_m - 1));
  ends.push_back(4 * high_m);
  std::sort(ends.begin(), ends.end());
  std::vector<terrain::Layer> layers;
  float start_m = 0.0F;
  for (const int end : ends) {
    const float end_m = static_cast<float>(end) / 4.0F;
    layers.push_back(
        {start_m, end_m, static_cast<terrain::Material>(draws.whole(0, materials - 1))});
    start_m = end_m;
  }
  return layers;
}

}  // namespace plumb::test_support
