// A scene in which a method fails, and what is expected to be measured there.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "core/camera.h"
#include "core/claim.h"
#include "core/drawn_surface.h"
#include "terrain/heightfield.h"

namespace plumb::audit::stability {

/// The number of an audit that tells whether a scene went wrong.
enum class Reading {
  PixelError,    // farthest on screen from the truth above or below a point drawn, px
  SampleError,   // farthest vertical deviation at a sample, in the tolerance's unit
  SurfaceError,  // the same between the samples as well
  NearestError,  // farthest from the nearest point of the other surface, both ways, px
  Coverage,      // holes, overshoots and see-through cracks, pixels
  OpenEdges,     // of the drawn mesh, where none should be
  TJunctions,
  NonManifold,  // edges and vertices
  Folded,       // triangles
  LevelJump,    // largest between triangles that share an edge
  Triangles,    // drawn
  TopError,     // farthest of a stack's, or a sample's, top from the highest surface drawn there, m
  ColourError,  // farthest that a colour of a pixel is from the truth's, of 1
};

const char* name_of(Reading reading);  // with hyphens; a claim's label, where there is such a claim
/// Of a reading, where the tolerance asked for has the unit `asked`.
Unit unit_of(Reading reading, Unit asked);

/// What a variant does in a scene, as stated before it is measured.
struct Expected {
  std::optional<Verdict> verdict;  // of the audit; nothing: either, but no number may be NaN
  Reading reading = Reading::PixelError;
  double least = 0.0;  // the reading lies in [least, most]
  double most = std::numeric_limits<double>::infinity();
  std::string refusal = {};  // not empty: it is not drawn, and the one line why holds this
};

/// Claims all hold, and the reading stays at or below `most`.
Expected holds(Reading reading, double most = std::numeric_limits<double>::infinity());
/// A claim is broken, and the reading reaches `least`.
Expected breaks(Reading reading, double least);
/// No claim is broken that is made, and yet the reading reaches `least`: nothing is claimed of it.
Expected strays(Reading reading, double least,
                double most = std::numeric_limits<double>::infinity());
/// Not drawn: the one line of an InputError or a std::invalid_argument holds `text`.
Expected refused(const std::string& text);
/// Whatever it is, no number is NaN.
Expected sound();

struct Scene {
  std::string name;                  // with hyphens
  std::vector<std::string> methods;  // of the table, each drawn
  std::string fails;                 // one sentence: what should go wrong
  /// Where the published variant does not show it, or something else was found: why.
  std::string finding = {};
  std::function<terrain::Heightfield()> terrain;
  LookAt camera;
  std::vector<LookAt> before = {};  // frames that are shown first
  Tolerance tolerance = {};
  std::optional<Tolerance> size = {};  // of a variant whose tolerance is a size, no error
  std::map<std::string, std::string> parameters = {};
  /// What stands for the published variant of a method that has none; null: nothing does.
  std::function<DrawnSurface(const terrain::Heightfield&, const Tolerance&)> as_printed = {};
  std::optional<Expected> published = {};  // nothing: the method has no such variant
  std::optional<Expected> conservative = {};
  std::map<std::string, Expected> otherwise = {};  // by method, in place of both
  bool is_degenerate = false;                      // input that is hardly any: no pictures
};

/// Every scene, those of a method together, degenerate input last; names are unique.
const std::vector<Scene>& failure_scenes();

/// Throws InputError that names them all.
const Scene& find_scene(const std::string& name);

}  // namespace plumb::audit::stability
