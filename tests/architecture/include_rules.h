// Who may include whom: the walls of the house, as a check of its sources.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::testing {

/// Reads every header and source under `root`/src, `root`/tools and `root`/examples.
///
/// returns  one line for each include that breaks a wall, "src/mesh/full/full.h:3: includes ...";
///          sorted, empty if every wall holds
///
/// The walls:
///   (1) A module of src/ includes itself and what stands on an earlier step:
///       core | terrain, image | raster, reference, report | slicing, mesh | gpu, audit.
///       `slicing` may use `raster`, but no method may use `reference`; `reference` includes
///       neither `raster` nor a method; a method's folder includes no other method's.
///   (2) src/ includes nothing of tools/ or tests/; tools/compare nothing of tools/plumb.
///   (3) Embree is known to `reference` alone, OpenImageIO to `image` and `terrain`, GDAL to
///       `terrain`; these and the TOML, JSON and command-line libraries to no header that is
///       installed (that the folder's CMakeLists.txt names).
///   (4) A folder of src/ that the walls do not know is a violation.
std::vector<std::string> broken_walls(const std::filesystem::path& root);

}  // namespace plumb::testing
