// FLIP's filters, written once for every number of lanes. Included by one file for each
// instruction set, which call no inline function that others share.
#pragma once

#include "compare/flip_kernels.h"

namespace plumb::compare {
namespace {

template <class L>
struct FilterKernels {
  using Real = typename L::Real;

  static Real weight(const float* tap, int filter) { return L::load(tap + filter * kFlipLanes); }

  // The point detector's weights sum to 0, so it is applied to differences from the middle: on
  // what is even it then gives 0 to the bit.
  static void filter_down(const FlipTaps& filters, const float* const* const above[3],
                          const float* const* const below[3], int count,
                          float* const out[kFlipFilters]) {
    const int reach = filters.reach;
    for (int i = 0; i < count; i += L::kCount) {
      const float* tap = filters.weights;
      const Real y = L::load(above[0][0] + i), cz = L::load(above[2][0] + i), twice = y + y;
      Real luminance = weight(tap, kLuminance) * y;
      Real red_green = weight(tap, kRedGreen) * L::load(above[1][0] + i);
      Real a = weight(tap, kBlueYellowA) * cz, b = weight(tap, kBlueYellowB) * cz;
      Real gauss = weight(tap, kGauss) * y, edge = L::all(0.0f), point = edge;
      for (int k = 1; k <= reach; ++k) {
        tap += kFlipFilters * kFlipLanes;
        const Real up = L::load(above[0][k] + i), down = L::load(below[0][k] + i);
        const Real both = up + down;
        luminance = luminance + weight(tap, kLuminance) * both;
        gauss = gauss + weight(tap, kGauss) * both;
        edge = edge + weight(tap, kEdge) * (down - up);
        point = point + weight(tap, kPoint) * (both - twice);
        red_green = red_green +
                    weight(tap, kRedGreen) * (L::load(above[1][k] + i) + L::load(below[1][k] + i));
        const Real yellow = L::load(above[2][k] + i) + L::load(below[2][k] + i);
        a = a + weight(tap, kBlueYellowA) * yellow;
        b = b + weight(tap, kBlueYellowB) * yellow;
      }
      L::store(out[kLuminance] + i, luminance);
      L::store(out[kRedGreen] + i, red_green);
      L::store(out[kBlueYellowA] + i, a);
      L::store(out[kBlueYellowB] + i, b);
      L::store(out[kGauss] + i, gauss);
      L::store(out[kEdge] + i, edge);
      L::store(out[kPoint] + i, point);
    }
  }

  static Real pair(const float* at, int k) { return L::load(at - k) + L::load(at + k); }

  static void filter_across(const FlipTaps& filters, const float* const in[kFlipFilters], int count,
                            float* const out[kFlipResponses]) {
    for (int i = 0; i < count; i += L::kCount) {
      const float* tap = filters.weights;
      const Real gauss = L::load(in[kGauss] + i), twice = gauss + gauss;
      Real y = weight(tap, kLuminance) * L::load(in[kLuminance] + i);
      Real cx = weight(tap, kRedGreen) * L::load(in[kRedGreen] + i);
      Real cz = weight(tap, kBlueYellowA) * L::load(in[kBlueYellowA] + i) +
                weight(tap, kBlueYellowB) * L::load(in[kBlueYellowB] + i);
      Real edge_x = L::all(0.0f), point_x = edge_x;
      Real edge_y = weight(tap, kGauss) * L::load(in[kEdge] + i);
      Real point_y = weight(tap, kGauss) * L::load(in[kPoint] + i);
      for (int k = 1; k <= filters.reach; ++k) {
        tap += kFlipFilters * kFlipLanes;
        y = y + weight(tap, kLuminance) * pair(in[kLuminance] + i, k);
        cx = cx + weight(tap, kRedGreen) * pair(in[kRedGreen] + i, k);
        cz = cz + (weight(tap, kBlueYellowA) * pair(in[kBlueYellowA] + i, k) +
                   weight(tap, kBlueYellowB) * pair(in[kBlueYellowB] + i, k));
        const Real west = L::load(in[kGauss] + i - k), east = L::load(in[kGauss] + i + k);
        edge_x = edge_x + weight(tap, kEdge) * (east - west);
        point_x = point_x + weight(tap, kPoint) * ((east + west) - twice);
        edge_y = edge_y + weight(tap, kGauss) * pair(in[kEdge] + i, k);
        point_y = point_y + weight(tap, kGauss) * pair(in[kPoint] + i, k);
      }
      L::store(out[kSeenY] + i, y);
      L::store(out[kSeenCx] + i, cx);
      L::store(out[kSeenCz] + i, cz);
      L::store(out[kEdgeX] + i, edge_x);
      L::store(out[kEdgeY] + i, edge_y);
      L::store(out[kPointX] + i, point_x);
      L::store(out[kPointY] + i, point_y);
    }
  }
};

}  // namespace
}  // namespace plumb::compare
