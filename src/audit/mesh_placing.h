// Every other way in which a mesh might have been meant. Not for users of the library.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <string>
#include <vector>

#include "terrain/mesh_file.h"

namespace plumb::audit {

/// The axes that become east, north and up, with their signs.
struct Axes {
  std::array<int, 3> axis{0, 1, 2};
  std::array<double, 3> sign{1.0, 1.0, 1.0};

  glm::dvec3 turned(const glm::dvec3& v) const {
    return {sign[0] * v[axis[0]], sign[1] * v[axis[1]], sign[2] * v[axis[2]]};
  }
  friend bool operator==(const Axes&, const Axes&) = default;
};

enum class Place {
  AsGiven,    // about the mesh's own (0, 0, 0)
  InPlace,    // turned about its own box, whose corner stays
  OwnOrigin,  // (0, 0, 0) at the terrain's origin
  NoOrigin,   // at the world's
  Corner,     // the box's corner at the terrain's
  Middle,     // the box's middle at the terrain's
};

struct Placing {
  Axes axes;
  double scale = 1.0;
  Place place = Place::AsGiven;

  /// Turning a mesh about its own box is one change.
  int changes() const {
    return (axes == Axes{} ? 0 : 1) + (scale == 1.0 ? 0 : 1) +
           (place == Place::AsGiven || place == Place::InPlace ? 0 : 1);
  }
};

/// All placings of one or two changes; `fitting_scale` is tried among the units.
std::vector<Placing> other_placings(double fitting_scale);

/// What axes of a mesh that was read with `up` mean: "y is its upward axis (--up y)".
std::string axes_text(const Axes& axes, terrain::UpAxis up);

}  // namespace plumb::audit
