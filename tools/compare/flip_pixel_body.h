// What FLIP does to each pixel by itself, written once for every number of lanes. Included by one
// file for each instruction set, which call no inline function that others share.
#pragma once

#include "compare/flip_kernels.h"
#include "compare/flip_powers_body.h"

namespace plumb::compare {
namespace {

template <class L>
struct PixelKernels {
  using Real = typename L::Real;
  using P = Powers<L>;

  static Real cut(Real x) { return L::least(L::greatest(x, L::all(0.0f)), L::all(1.0f)); }

  static Real row_of(const float* matrix, int row, Real a, Real b, Real c) {
    const float* m = matrix + 3 * row;
    return (L::all(m[0]) * a + L::all(m[1]) * b) + L::all(m[2]) * c;
  }

  static void linearise(const float* srgb, int count, float* linear) {
    for (int i = 0; i < count; i += L::kCount) {
      const Real x = cut(L::load(srgb + i));
      const Real curve = P::power((x + L::all(0.055f)) / L::all(1.055f), L::all(2.4f));
      const Real line = x / L::all(12.92f);
      L::store(linear + i,
               L::least(L::choose(L::less(L::all(0.04045f), x), curve, line), L::all(1.0f)));
    }
  }

  // What is brighter than 2^60 is as good as that: its square is still finite.
  static void expose(const ToneCurve& curve, float gain, int count, float* const rgb[3]) {
    const Real most = L::all(0x1p60f), zero = L::all(0.0f), one = L::all(1.0f);
    for (int i = 0; i < count; i += L::kCount) {
      Real x[3];
      for (int c = 0; c < 3; ++c)
        x[c] = L::least(L::greatest(L::load(rgb[c] + i), zero) * L::all(gain), most);
      const Real luminance =
          (L::all(0.2126f) * x[0] + L::all(0.7152f) * x[1]) + L::all(0.0722f) * x[2];
      for (int c = 0; c < 3; ++c) {
        const Real above = (L::all(curve.k[0]) * x[c] + L::all(curve.k[1])) * x[c];
        const Real below = (L::all(curve.k[3]) * x[c] + L::all(curve.k[4])) * x[c];
        const Real mapped = (above + L::all(curve.k[2])) /
                            (curve.by_luminance ? one + luminance : below + L::all(curve.k[5]));
        L::store(rgb[c] + i, cut(mapped));
      }
    }
  }

  static void to_opponent(const FlipConstants& constants, int count, float* const rgb[3]) {
    for (int i = 0; i < count; i += L::kCount) {
      const Real r = L::load(rgb[0] + i), g = L::load(rgb[1] + i), b = L::load(rgb[2] + i);
      for (int row = 0; row < 3; ++row)
        L::store(rgb[row] + i, row_of(constants.to_opponent, row, r, g, b));
    }
  }

  // The cube root, and below (6/29)^3 the line that touches it.
  static Real lightness(Real t) {
    const Real root = P::power(t, L::all(1.0f / 3.0f));
    const Real line = t * L::all(841.0f / 108.0f) + L::all(4.0f / 29.0f);
    return L::choose(L::less(L::all(216.0f / 24389.0f), t), root, line);
  }

  static void to_hunt_lab(const FlipConstants& constants, int count, float* const seen[3]) {
    for (int i = 0; i < count; i += L::kCount) {
      const Real y = L::load(seen[0] + i), cx = L::load(seen[1] + i), cz = L::load(seen[2] + i);
      Real rgb[3], f[3];
      for (int c = 0; c < 3; ++c) rgb[c] = cut(row_of(constants.from_opponent, c, y, cx, cz));
      for (int c = 0; c < 3; ++c)
        f[c] = lightness(row_of(constants.to_xyz, c, rgb[0], rgb[1], rgb[2]));
      const Real star = L::all(116.0f) * f[1] - L::all(16.0f), hunt = L::all(0.01f) * star;
      L::store(seen[0] + i, star);
      L::store(seen[1] + i, hunt * (L::all(500.0f) * (f[0] - f[1])));
      L::store(seen[2] + i, hunt * (L::all(200.0f) * (f[1] - f[2])));
    }
  }

  static void differ_in_colour(const FlipConstants& constants, const float* const reference[3],
                               const float* const candidate[3], int count, float* out) {
    for (int i = 0; i < count; i += L::kCount) {
      const Real l = L::load(reference[0] + i) - L::load(candidate[0] + i);
      const Real a = L::load(reference[1] + i) - L::load(candidate[1] + i);
      const Real b = L::load(reference[2] + i) - L::load(candidate[2] + i);
      const Real distance = P::power(L::magnitude(l) + L::root(a * a + b * b), L::all(0.7f));
      const Real gentle = L::all(constants.gentle) * distance;
      const Real steep = L::all(constants.offset) + L::all(constants.steep) * distance;
      L::store(out + i, cut(L::choose(L::less(distance, L::all(constants.knee)), gentle, steep)));
    }
  }

  static Real strength(const float* x, const float* y) {
    const Real a = L::load(x), b = L::load(y);
    return L::root(a * a + b * b);
  }

  static void differ_in_features(const float* const reference[4], const float* const candidate[4],
                                 int count, float* out) {
    for (int i = 0; i < count; i += L::kCount) {
      Real difference[2];
      for (int kind = 0; kind < 2; ++kind) {
        const int x = 2 * kind, y = x + 1;
        difference[kind] = L::magnitude(strength(reference[x] + i, reference[y] + i) -
                                        strength(candidate[x] + i, candidate[y] + i));
      }
      const Real larger = L::greatest(difference[0], difference[1]);
      L::store(out + i, cut(L::root(larger * L::all(0.70710678f))));
    }
  }

  static void combine(const float* colour, const float* feature, int count, float* error) {
    for (int i = 0; i < count; i += L::kCount) {
      const Real exponent = L::all(1.0f) - L::load(feature + i);
      L::store(error + i, cut(P::power(L::load(colour + i), exponent)));
    }
  }
};

}  // namespace
}  // namespace plumb::compare
