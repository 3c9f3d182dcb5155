#include "audit/mesh_placing.h"

#include <algorithm>

namespace plumb::audit {
namespace {

std::vector<Axes> all_axes() {
  std::vector<Axes> all;
  std::array<int, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      all.push_back(
          {order, {signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0, signs & 4 ? -1.0 : 1.0}});
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

}  // namespace

std::vector<Placing> other_placings(double fitting_scale) {
  const std::vector<double> scales{1.0,    0.3048, 1.0 / 0.3048, 0.01, 100.0, 0.001,        1000.0,
                                   0.9144, 0.1,    10.0,         2.0,  0.5,   fitting_scale};
  std::vector<Placing> placings;
  for (const Axes& axes : all_axes()) {
    for (const double scale : scales) {
      for (const Place place : {Place::AsGiven, Place::InPlace, Place::OwnOrigin, Place::NoOrigin,
                                Place::Corner, Place::Middle}) {
        const Placing placing{axes, scale, place};
        if (placing.changes() >= 1 && placing.changes() <= 2) placings.push_back(placing);
      }
    }
  }
  return placings;
}

std::string axes_text(const Axes& axes, terrain::UpAxis up) {
  const auto is = [&](std::array<int, 3> axis, std::array<double, 3> sign) {
    return axes == Axes{axis, sign};
  };
  if (is({0, 2, 1}, {1.0, -1.0, 1.0}) && up == terrain::UpAxis::Z)
    return "y is its upward axis (--up y)";
  if (is({0, 2, 1}, {1.0, 1.0, -1.0}) && up == terrain::UpAxis::Y)
    return "z is its upward axis (--up z)";
  if (is({0, 1, 2}, {1.0, -1.0, 1.0})) return "north and south are exchanged";
  if (is({0, 1, 2}, {-1.0, 1.0, 1.0})) return "east and west are exchanged";
  if (is({0, 1, 2}, {-1.0, -1.0, 1.0})) return "it is turned by half a turn";
  if (is({0, 1, 2}, {1.0, 1.0, -1.0})) return "up and down are exchanged";
  if (is({1, 0, 2}, {1.0, 1.0, 1.0})) return "its x and y are exchanged";
  if (is({0, 2, 1}, {1.0, 1.0, 1.0})) return "y is its upward axis and z points north";
  std::string text = "as it is read, east, north and up are its ";
  for (std::size_t k = 0; k < 3; ++k) {
    text += k == 0 ? "" : ", ";
    text += axes.sign[k] < 0.0 ? "-" : "";
    text += static_cast<char>('x' + axes.axis[k]);
  }
  return text;
}

}  // namespace plumb::audit
