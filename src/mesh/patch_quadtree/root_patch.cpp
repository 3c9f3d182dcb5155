// The patch without a parent.
#include <algorithm>
#include <bit>
#include <cstdlib>

#include "mesh/patch_quadtree/arithmetic_coder.h"
#include "mesh/patch_quadtree/modelled_patch.h"
#include "mesh/patch_quadtree/void_mask.h"

namespace plumb::mesh::patch_quadtree {
namespace {

constexpr int kContextsOfRoot = 12;
constexpr int kSymbols = 32;  // numbers from zero up to 30; the last one is followed by the rest

// The median of left, below and left + below - diagonal: flat, a step along either axis, or a
// slope.
std::int32_t foretold(const Grid<std::int32_t>& q, int i, int j) {
  const std::int32_t left = i > 0 ? q(i - 1, j) : j > 0 ? q(i, j - 1) : 0;
  const std::int32_t below = j > 0 ? q(i, j - 1) : left;
  const std::int32_t diagonal = i > 0 && j > 0 ? q(i - 1, j - 1) : i > 0 ? left : below;
  const std::int32_t low = std::min(left, below), high = std::max(left, below);
  return std::clamp(left + below - diagonal, low, high);
}

int context_at(const Grid<std::int32_t>& q, int i, int j) {
  if (i == 0 || j == 0) return kContextsOfRoot - 1;
  const int right = i + 1 < q.columns() ? i + 1 : i;
  const std::int32_t liveliness = std::abs(q(i - 1, j) - q(i - 1, j - 1)) +
                                  std::abs(q(i, j - 1) - q(i - 1, j - 1)) +
                                  std::abs(q(right, j - 1) - q(i, j - 1));
  return std::min(kContextsOfRoot - 2,
                  static_cast<int>(std::bit_width(static_cast<std::uint32_t>(liveliness))));
}

// Every number in turn, from code(foretold, model, number); voids take what is foretold meanwhile.
template <class Code>
void visit(PatchNumbers& root, const Code& code) {
  std::vector<AdaptiveModel> models(kContextsOfRoot, AdaptiveModel(kSymbols));
  for (int j = 0; j < root.q.rows(); ++j) {
    for (int i = 0; i < root.q.columns(); ++i) {
      const std::int32_t p = foretold(root.q, i, j);
      const bool is_void = root.has_voids() && root.voids(i, j) != 0;
      root.q(i, j) = is_void ? p
                             : code(p, models[static_cast<std::size_t>(context_at(root.q, i, j))],
                                    root.q(i, j));
    }
  }
}

}  // namespace

Bytes encode_root(const PatchNumbers& given) {
  PatchNumbers root = given;
  Bytes bytes;
  bytes.push_back(root.has_voids() ? 1 : 0);
  if (root.has_voids()) {
    const Bytes voids = encode_voids(
        root.voids, Grid<std::uint8_t>(root.voids.columns(), root.voids.rows(), kUnknownVoid));
    put_part(voids, bytes);
  }
  ArithmeticEncoder encoder;
  GammaWriter escapes;
  visit(root, [&](std::int32_t p, AdaptiveModel& model, std::int32_t q) {
    const std::uint32_t number = folded(q - p);
    const std::uint32_t symbol = std::min<std::uint32_t>(number, kSymbols - 1);
    encoder.put(static_cast<int>(symbol), model);
    if (symbol == kSymbols - 1) escapes.put(number - symbol + 1);
    return q;
  });
  put_part(escapes.bytes(), bytes);
  const Bytes coded = encoder.finish();
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  return bytes;
}

bool decode_root(std::span<const std::uint8_t> bytes, int patch_cells, StepRule rule,
                 PatchNumbers& root) {
  const int side = patch_cells + 3;
  root = {Grid<std::int32_t>(side, side), {}};
  ByteReader reader(bytes);
  const std::uint8_t flags = reader.byte();
  if (flags > 1) return false;
  if (flags == 1 && !decode_voids(reader.bytes(reader.number()),
                                  Grid<std::uint8_t>(side, side, kUnknownVoid), root.voids))
    return false;
  GammaReader escapes(reader.bytes(reader.number()));
  ArithmeticDecoder decoder(reader.rest());
  visit(root, [&](std::int32_t p, AdaptiveModel& model, std::int32_t) {
    auto number = static_cast<std::uint32_t>(decoder.take(model));
    if (number == kSymbols - 1) number += escapes.take() - 1;
    return as_number(std::int64_t{p} + unfolded(number), rule);
  });
  for (std::size_t k = 0; root.has_voids() && k < root.q.size(); ++k) {
    if (root.voids.values()[k] != 0) root.q.values()[k] = 0;
  }
  return !decoder.overrun() && !escapes.overrun() && !reader.overrun();
}

}  // namespace plumb::mesh::patch_quadtree
