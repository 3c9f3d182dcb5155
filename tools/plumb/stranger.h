// What somebody else drew: a mesh or a depth buffer from a file, in a method's place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/truth.h"
#include "audit/truth_terms.h"
#include "core/camera.h"
#include "core/claim.h"
#include "core/drawn_surface.h"
#include "options.h"

namespace plumb::tool {

struct StrangerOptions {
  std::string mesh_file, offset, up;
  std::optional<double> scale;
  std::string depth_file, depth_channel, depth_convention, depth_y, depth_raw;
  std::optional<double> depth_scale, depth_sky;
  int depth_bits = 0;
  bool trusted = false;  // audited even if it seems to fit nowhere

  bool is_mesh() const { return !mesh_file.empty(); }
  bool is_depth() const { return !depth_file.empty(); }
  bool is_given() const { return is_mesh() || is_depth(); }
  /// "mesh a.ply", "depth a.exr".
  std::string name() const;
};

void add_stranger_options(Options& options, StrangerOptions& stranger);

/// Throws InputError for options that belong to the other kind of file, to none, or to a method.
void require_consistent(const StrangerOptions& stranger, const std::vector<std::string>& arguments);

/// A stranger's surface and what a report says about it.
struct Stranger {
  DrawnSurface surface;
  std::vector<std::string> assumptions = {}, hints = {};
  std::vector<std::string> warnings = {};  // for standard error: the hints, and more
  std::vector<std::pair<std::string, std::string>> parameters = {};
};

/// The mesh, which is held against the terrain through the first camera. It claims what `tolerance`
/// says: in pixels the pixel error, in metres the sample error; of a terrain of stacks the distance
/// to the nearest point. Throws InputError for a file that
/// cannot be read and a mesh that does not fit.
Stranger read_stranger_mesh(const StrangerOptions& options, const audit::TruthTerms& truth,
                            const Camera& camera, const Tolerance& tolerance);

/// The depth buffer and the picture that it is; it claims the pixel error in the tolerance's unit.
/// Throws InputError for a file that cannot be read, is of another size than the camera, holds
/// numbers that are no depths, or does not fit.
struct DepthFrame {
  Stranger stranger;
  HitImage true_hits, drawn;
};
DepthFrame read_depth_frame(const StrangerOptions& options, const audit::HeightfieldTruth& truth,
                            const Camera& camera, const audit::Band& band,
                            const Tolerance& tolerance);

}  // namespace plumb::tool
