// Polygons from the formats that Assimp reads. Not for users of the library.
#pragma once

#include <string>

#include "terrain/polygon_soup.h"

namespace plumb::terrain {

struct AssimpPolygons {
  PolygonSoup soup;
  /// The largest number that was rounded to single precision on the way, or that a sum of such
  /// numbers can come to: coordinates, and the shifts of the file's nodes.
  double largest_rounded_m = 0.0;
};

/// Reads all meshes of the file, cut into triangles; points and lines are left out. Assimp keeps
/// coordinates in single precision; the nodes' transforms are applied to them in double. `name`
/// begins the messages of its InputErrors.
AssimpPolygons read_with_assimp(const std::string& path, const std::string& name);

}  // namespace plumb::terrain
