// What one triangle does to one row of samples: the audit's innermost loop.
#pragma once

#include "core/instruction_set.h"

namespace plumb::audit {

/// A FlatTriangle's numbers: corners counter-clockwise in the plane, heights, and its slack.
struct CoverTriangle {
  double ax, ay, az, bx, by, bz, cx, cy, cz;
  double slack;
  double index;
};

/// One row of samples and the worst over each so far. All arrays have room for kPadding entries
/// after the last.
struct CoverRow {
  static constexpr int kPadding = 8;

  double y_m, dx_m;        // of the row; between its samples
  const float* heights_m;  // of the truth
  double* delta_m;         // drawn minus truth
  double* triangle;        // its number; negative where nothing is drawn yet
  double* sheets;          // triangles that hold the sample in their inside
};

/// Lays the triangle over the samples first ... last of the row, as FlatTriangle::cover and
/// Deviation::add have it, to the bit. Returns its largest distance from one of them, metres.
using CoverSamples = double (*)(const CoverTriangle& triangle, const CoverRow& row, int first,
                                int last);

CoverSamples cover_samples(InstructionSet set);

}  // namespace plumb::audit
