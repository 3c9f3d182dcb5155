#include "mesh/patch_quadtree/void_mask.h"

#include <vector>

#include "mesh/patch_quadtree/arithmetic_coder.h"

namespace plumb::mesh::patch_quadtree {
namespace {

// A model for each of what is to the left, below, below to either side, and known to the right and
// above.
class Models {
 public:
  Models() : models_(16 * 9, AdaptiveModel(2)) {}

  AdaptiveModel& of(const Grid<std::uint8_t>& mask, const Grid<std::uint8_t>& known, int i, int j) {
    const auto at = [&](int a, int b) -> std::size_t {
      return mask.contains(a, b) ? mask(a, b) : 0u;
    };
    const auto ahead = [&](int a, int b) -> std::size_t {
      return known.contains(a, b) ? known(a, b) : kUnknownVoid;
    };
    const std::size_t before =
        at(i - 1, j) + 2 * at(i, j - 1) + 4 * at(i + 1, j - 1) + 8 * at(i - 1, j - 1);
    return models_[9 * before + 3 * ahead(i + 1, j) + ahead(i, j + 1)];
  }

 private:
  std::vector<AdaptiveModel> models_;
};

// put(i, j, model) for every place that is coded; what is known is copied.
template <class Put>
void visit(const Grid<std::uint8_t>& known, Grid<std::uint8_t>& mask, const Put& put) {
  Models models;
  for (int j = 0; j < mask.rows(); ++j) {
    for (int i = 0; i < mask.columns(); ++i) {
      mask(i, j) =
          known(i, j) != kUnknownVoid ? known(i, j) : put(i, j, models.of(mask, known, i, j));
    }
  }
}

}  // namespace

Grid<std::uint8_t> known_voids(const Grid<std::uint8_t>& parent, int s, int t, int n) {
  Grid<std::uint8_t> known(n + 3, n + 3, kUnknownVoid);
  for (int j = 0; j <= n; j += 2) {
    for (int i = 0; i <= n; i += 2)
      known(i + 1, j + 1) =
          parent.empty() ? std::uint8_t{0} : parent(i / 2 + s * n / 2 + 1, j / 2 + t * n / 2 + 1);
  }
  return known;
}

Bytes encode_voids(const Grid<std::uint8_t>& mask, const Grid<std::uint8_t>& known) {
  ArithmeticEncoder encoder;
  Grid<std::uint8_t> seen(mask.columns(), mask.rows());
  visit(known, seen, [&](int i, int j, AdaptiveModel& model) {
    encoder.put(mask(i, j), model);
    return mask(i, j);
  });
  return encoder.finish();
}

bool decode_voids(std::span<const std::uint8_t> bytes, const Grid<std::uint8_t>& known,
                  Grid<std::uint8_t>& mask) {
  ArithmeticDecoder decoder(bytes);
  mask = Grid<std::uint8_t>(known.columns(), known.rows());
  visit(known, mask, [&](int, int, AdaptiveModel& model) {
    return static_cast<std::uint8_t>(decoder.take(model));
  });
  return !decoder.overrun();
}

}  // namespace plumb::mesh::patch_quadtree
