#include "mesh/patch_quadtree/published_family.h"

#include <algorithm>
#include <cstdlib>

#include "mesh/patch_quadtree/arithmetic_coder.h"
#include "mesh/patch_quadtree/void_mask.h"

namespace plumb::mesh::patch_quadtree {
namespace {

constexpr int kMagnitudes = 256, kEscape = 255;
enum Flags : std::uint8_t { NoVoids = 0, SomeVoids = 1 };

// The models of a family.
struct Models {
  AdaptiveModel refinement{3}, magnitude{kMagnitudes}, sign{2};
};

// A child's numbers from -2 to n + 2; those at -2 and n + 2 are twice the parent's.
class Wide {
 public:
  Wide(const Grid<std::int32_t>& parent, int s, int t)
      : n_(parent.columns() - 3), grid_(n_ + 5, n_ + 5) {
    for (int j = -2; j <= n_ + 2; j += 2) {
      for (int i = -2; i <= n_ + 2; i += 2)
        (*this)(i, j) = 2 * parent(i / 2 + s * n_ / 2 + 1, j / 2 + t * n_ / 2 + 1);
    }
  }
  int n() const { return n_; }
  std::int32_t& operator()(int i, int j) { return grid_(i + 2, j + 2); }

 private:
  int n_;
  Grid<std::int32_t> grid_;
};

bool is_odd(int i) { return (i & 1) != 0; }

std::int32_t foretold(Wide& q, int i, int j) {
  if (is_odd(i) && is_odd(j))
    return (q(i - 1, j - 1) + q(i + 1, j - 1) + q(i - 1, j + 1) + q(i + 1, j + 1) + 2) >> 2;
  if (is_odd(i)) return (q(i - 1, j) + q(i + 1, j) + 1) >> 1;
  return (q(i, j - 1) + q(i, j + 1) + 1) >> 1;
}

// Every sample of the child: refine(i, j, twice the parent's) of even ones, then predict(i, j,
// foretold) of the others; both give the number. Voids are passed over: theirs is what they begin
// with or what is foretold.
template <class Refine, class Predict>
void visit(Wide& q, const Grid<std::uint8_t>& voids, const Refine& refine, const Predict& predict) {
  const int n = q.n();
  const auto is_void = [&](int i, int j) { return !voids.empty() && voids(i + 1, j + 1) != 0; };
  for (int j = 0; j <= n; j += 2) {
    for (int i = 0; i <= n; i += 2) {
      if (!is_void(i, j)) q(i, j) = refine(i, j, q(i, j));
    }
  }
  for (int j = -1; j <= n + 1; ++j) {
    for (int i = -1; i <= n + 1; ++i) {
      if (!is_odd(i) && !is_odd(j)) continue;
      const std::int32_t p = foretold(q, i, j);
      q(i, j) = is_void(i, j) ? p : predict(i, j, p);
    }
  }
}

void encode_child(const PatchNumbers& parent, int s, int t, const PatchNumbers& child,
                  Models& models, ArithmeticEncoder& encoder, GammaWriter& escapes) {
  Wide q(parent.q, s, t);
  visit(
      q, child.voids,
      [&](int i, int j, std::int32_t twice) {
        const std::int32_t number = child.q(i + 1, j + 1);
        encoder.put(number - twice + 1, models.refinement);
        return number;
      },
      [&](int i, int j, std::int32_t p) {
        const std::int32_t number = child.q(i + 1, j + 1), off = p - number;
        const std::int32_t magnitude = std::abs(off);
        encoder.put(std::min(magnitude, kEscape), models.magnitude);
        if (magnitude >= kEscape) escapes.put(static_cast<std::uint32_t>(magnitude - kEscape + 1));
        if (magnitude > 0) encoder.put(off < 0 ? 1 : 0, models.sign);
        return number;
      });
}

void decode_child(const PatchNumbers& parent, int s, int t, Models& models,
                  ArithmeticDecoder& decoder, GammaReader& escapes, PatchNumbers& child) {
  Wide q(parent.q, s, t);
  visit(
      q, child.voids,
      [&](int, int, std::int32_t twice) {
        return as_number(twice + decoder.take(models.refinement) - 1, StepRule::DoublesWithLevel);
      },
      [&](int, int, std::int32_t p) {
        std::int64_t magnitude = decoder.take(models.magnitude);
        if (magnitude == kEscape) magnitude += std::int64_t{escapes.take()} - 1;
        if (magnitude == 0) return as_number(p, StepRule::DoublesWithLevel);
        return as_number(decoder.take(models.sign) == 1 ? p + magnitude : p - magnitude,
                         StepRule::DoublesWithLevel);
      });
  for (int j = -1; j <= q.n() + 1; ++j) {
    for (int i = -1; i <= q.n() + 1; ++i) {
      const bool is_void = child.has_voids() && child.voids(i + 1, j + 1) != 0;
      child.q(i + 1, j + 1) = is_void ? 0 : q(i, j);
    }
  }
}

}  // namespace

Bytes encode_family(const PatchNumbers& parent, const Family& children) {
  Bytes bytes;
  Models models;
  ArithmeticEncoder encoder;
  GammaWriter escapes;
  for (int k = 0; k < 4; ++k) {
    const auto& child = children[static_cast<std::size_t>(k)];
    if (!child) continue;
    bytes.push_back(child->has_voids() ? SomeVoids : NoVoids);
    if (child->has_voids())
      put_part(encode_voids(child->voids,
                            known_voids(parent.voids, k & 1, k >> 1, child->q.columns() - 3)),
               bytes);
    encode_child(parent, k & 1, k >> 1, *child, models, encoder, escapes);
  }
  put_part(escapes.bytes(), bytes);
  const Bytes coded = encoder.finish();
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  return bytes;
}

bool decode_family(const PatchNumbers& parent, const std::array<bool, 4>& there,
                   std::span<const std::uint8_t> bytes, Family& children) {
  const int side = parent.q.columns();
  ByteReader reader(bytes);
  for (std::size_t k = 0; k < 4; ++k) {
    children[k].reset();
    if (!there[k]) continue;
    children[k] = PatchNumbers{Grid<std::int32_t>(side, side), {}};
    const std::uint8_t flags = reader.byte();
    const int s = static_cast<int>(k) & 1, t = static_cast<int>(k) >> 1;
    if (flags > SomeVoids ||
        (flags == SomeVoids &&
         !decode_voids(reader.bytes(reader.number()), known_voids(parent.voids, s, t, side - 3),
                       children[k]->voids)))
      return false;
  }
  GammaReader escapes(reader.bytes(reader.number()));
  ArithmeticDecoder decoder(reader.rest());
  Models models;
  for (std::size_t k = 0; k < 4; ++k) {
    if (there[k])
      decode_child(parent, static_cast<int>(k) & 1, static_cast<int>(k) >> 1, models, decoder,
                   escapes, *children[k]);
  }
  return !decoder.overrun() && !escapes.overrun() && !reader.overrun();
}

}  // namespace plumb::mesh::patch_quadtree
