// Polygons from PLY files. Not for users of the library.
#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <string>

#include "terrain/forward_file.h"
#include "terrain/polygon_soup.h"

namespace plumb::terrain {

struct PlyPolygons {
  PolygonSoup soup;
  bool single_precision = false;        // one of x, y, z is a float
  std::optional<std::string> origin_m;  // what "comment origin_m" says (ply_header.h)
};

/// Reads a PLY file, ascii or binary in either byte order: x, y and z of element `vertex` in
/// double, whatever their types, and the list `vertex_indices` (or `vertex_index`) of element
/// `face`; other properties and elements are skipped.
///
///   (1) Memory is asked for only as far as the file is long enough to fill it.
/// Throws InputError with the line (ascii) or the byte (binary) and what was expected: a file that
/// ends early, coordinates that are not finite, indices of no vertex.
PlyPolygons read_ply(ForwardFile& file);

}  // namespace plumb::terrain
