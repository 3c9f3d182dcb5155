// Drawn meshes as PLY files.
#pragma once

#include <filesystem>

#include "core/drawn_surface.h"

namespace plumb::audit {

/// Writes the surface's mesh as binary little-endian PLY 1.0: vertices x, y, z as doubles relative
/// to the origin that a comment names ("origin_m X Y Z", exact), faces with `vertex_indices` (three
/// uint32), `patch` and `lod` (int32; 0 where the surface has none).
///
///   (1) The same surface gives the same bytes.
///   (2) The file appears whole or not at all.
/// Throws InputError with path and cause if it cannot be written, std::invalid_argument if the
/// surface has no mesh.
void write_ply(const std::filesystem::path& path, const DrawnSurface& surface);

}  // namespace plumb::audit
