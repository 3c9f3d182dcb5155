// One draw: a terrain, a view, a method and what is asked of it, all sayable on the command line.
#pragma once

#include <cstdint>
#include <string>

#include "audit/method.h"
#include "audit/scene.h"

namespace plumb::audit::soundness {

/// How the eye was placed.
enum class Placement {
  Preset,
  Orbit,        // above the terrain, looking at some of it
  NearGround,   // a thousandth of a spacing to ten above the surface
  AtSample,     // exactly over, or on, a sample, looking at another
  Inside,       // in the terrain's box: above or below the ground
  Underground,  // below the lowest sample, looking up
  Grazing,      // outside, level with the heights
  StraightDown,
  FarAway,  // 10 to 10,000 times the terrain's size away
  Away,     // looks away from the terrain
};
inline constexpr int kPlacements = 10;
const char* name_of(Placement placement);  // "preset", "orbit", "near-ground", ...

/// What a case reaches: by these the distribution of many is told.
struct Traits {
  std::string generator;
  int columns = 0, rows = 0;
  bool not_square_cells = false;
  bool far_origin = false;  // farther from zero than 100 km
  bool windowed = false;
  bool filled = false;
  double void_part = 0.0;    // of the samples
  double relief_part = 0.0;  // height difference per length of the longer side
  Placement placement = Placement::Preset;
  double fov_y_deg = 0.0;
  bool rolled = false, off_centre = false, tilted = false;
  bool clipped = false;       // near or far planes of its own
  bool below_ground = false;  // the eye stands below the sample nearest to it
};

struct Case {
  std::uint64_t seed = 0;
  std::int64_t index = 0;
  Scene scene;
  Traits traits;
};

/// The case that a seed gives an index: the same for every machine and every other case.
///
/// table  methods with a variant `conservative` are drawn, and that variant; parameters of those
///        that come with plumb are drawn too, others keep their defaults
/// only   a method's name, or empty for all of them
///
///   (1) Terrain, camera and parameters are inside what their documentation allows.
/// Throws InputError for a method that the table lacks, or without such a variant.
Case draw_case(const MethodTable& table, std::uint64_t seed, std::int64_t index,
               const std::string& only = "");

/// The line for a shell that audits the scene: plumb audit '...' --camera ... --method ....
///
///   (1) Read by the command, it gives the same terrain, camera, method and tolerance, to the last
///       bit.
std::string audit_command(const Scene& scene);

/// A word as a POSIX shell reads it again.
std::string shell_word(const std::string& text);

}  // namespace plumb::audit::soundness
