// Polygons from Wavefront OBJ files. Not for users of the library.
#pragma once

#include "terrain/forward_file.h"
#include "terrain/polygon_soup.h"

namespace plumb::terrain {

/// Reads the lines `v` and `f` of an OBJ file, in double; all others are skipped, so that groups,
/// objects and materials are one mesh.
///
/// `v X Y Z`, with a colour or other numbers behind, which are ignored; of exactly four numbers the
/// last is a weight, which divides the others. `f` with corners V, V/VT, V//VN or V/VT/VN, of which
/// V counts: from 1 over the whole file, before or behind the face, or from -1 backwards from it.
/// A `#` begins a comment, a `\` at a line's end joins the next one.
/// Throws InputError with the line and what was expected.
PolygonSoup read_obj(ForwardFile& file);

}  // namespace plumb::terrain
