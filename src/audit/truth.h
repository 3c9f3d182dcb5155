// The truth that a drawn heightfield is held against.
#pragma once

#include "core/camera.h"
#include "core/hit_image.h"
#include "reference/pyramid_caster.h"
#include "reference/surface_height.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// A heightfield's full-detail surface with what is needed to question it. Keeps a reference to the
/// terrain.
struct HeightfieldTruth {
  reference::PyramidCaster caster;
  double slack_m;         // reference::evaluation_slack_m
  double steepest_slope;  // of a triangle, at most: reference::SurfaceRounding

  HeightfieldTruth(const terrain::Heightfield& field, terrain::Diagonal diagonal)
      : HeightfieldTruth(field, diagonal, reference::surface_rounding(field)) {}

  const terrain::Heightfield& field() const { return caster.field(); }
  terrain::Diagonal diagonal() const { return caster.diagonal(); }
  /// NaN where there is no surface; (x, y) relative to the terrain's origin.
  double height_at(double x_m, double y_m) const {
    return reference::surface_at(field(), diagonal(), x_m, y_m).height_m;
  }

 private:
  HeightfieldTruth(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                   const reference::SurfaceRounding& rounding)
      : caster(field, diagonal),
        slack_m(rounding.slack_m),
        steepest_slope(rounding.steepest_slope) {}
};

}  // namespace plumb::audit
