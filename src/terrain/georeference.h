// Where a file's samples stand on the ground, in metres.
#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <string>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/read_options.h"

namespace plumb::terrain {

/// What kind of coordinates a file's columns and rows are laid out in.
enum class Frame {
  Unstated,    // the file gives a spacing, but not in what
  Projected,   // lengths
  Mercator,    // lengths that grow as 1 / cos(latitude): Web Mercator
  Geographic,  // angles
};

/// What a file says about its place.
struct FileGeoreference {
  bool has_transform = false;
  /// x = t[0] + column * t[1] + row * t[2], y = t[3] + column * t[4] + row * t[5], of a pixel's
  /// upper left corner; a sample stands at its pixel's centre, half a column and half a row
  /// further.
  std::array<double, 6> transform{0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  Frame frame = Frame::Unstated;
  std::string crs;                            // "EPSG:2056", or a name; empty if unstated
  double metres_per_unit = 1.0;               // Projected, Mercator
  double degrees_per_unit = 1.0;              // Geographic
  double semi_major_m = 6378137.0;            // of the ellipsoid; WGS 84 by default
  double inverse_flattening = 298.257223563;  // 0 for a sphere
};

/// Where the samples of a window stand.
struct Placement {
  double dx_m = 1.0, dy_m = 1.0;
  glm::dvec2 origin_m{0.0};    // of the south-west sample
  bool rows_run_south = true;  // as the file stores them
  bool is_local = false;       // the origin is none of the file's coordinates
  std::vector<std::string> assumptions;
};

struct MetresPerDegree {
  double east, north;
};

/// Lengths of a degree of longitude and of latitude on an ellipsoid at a latitude in [-90, 90].
/// Source: the radii of curvature in the prime vertical and in the meridian.
MetresPerDegree metres_per_degree(double latitude_deg, double semi_major_m = 6378137.0,
                                  double inverse_flattening = 298.257223563);

/// Lays a window of `file` out in metres, as its options and georeference say.
///
/// Projected: the coordinates of the file in metres. Mercator: the same, all multiplied by the
/// cosine of the window's central latitude. Geographic: a plane that touches the earth at the
/// window's centre; its origin (0, 0) is the south-west sample. With a spacing from the user, or
/// without any: the origin (0, 0) is the south-west sample.
/// Throws InputError that names `file` if its transform is rotated, mirrored or not finite, or if
/// it has no spacing and options.require_spacing.
Placement place(const FileGeoreference& georeference, const Window& window,
                const ReadOptions& options, const std::string& file);

/// Sets the field's spacing and origin, and puts the placement's assumptions before its others.
void settle(Heightfield& field, const Placement& placement);

/// Metres in a unit of length as elevation files write it ("m", "ft", "US survey foot", ...); 0 if
/// the name is unknown. The empty name counts as metres.
double metres_in_unit(const std::string& unit);

}  // namespace plumb::terrain
