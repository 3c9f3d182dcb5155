// What changes from one frame of a path to the next that the camera's own motion does not explain:
// popping, and levels of detail that flicker.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/temporal/frame.h"
#include "audit/truth_terms.h"

namespace plumb::audit::temporal {

/// What was drawn at a place in one of the frames.
struct DrawnThere {
  std::uint32_t primitive = kNoPrimitive;  // triangle, or patch of a surface without a mesh
  int patch = -1;                          // -1: the surface has no patches
  std::string patch_name = {};
  int level = -1;  // 0 the finest; -1: the surface has no levels
};

struct PoppedPlace {
  int x = 0, y = 0;          // pixel of the later frame
  glm::dvec3 world_m{0.0};   // the truth's point there
  double px = 0.0, m = 0.0;  // how far what is drawn there went
  DrawnThere before, after;
};

/// What the vertices of either frame's mesh show: places at which a surface of heights bends, seen
/// or hidden.
struct PoppedVertices {
  std::int64_t count = 0;  // those in view of both frames, over which both frames draw
  double max_px = 0.0, max_m = 0.0;
  glm::dvec3 worst_m{0.0};  // of max_px, world coordinates
};

/// How far what is drawn went between two frames, both seen by the later frame's camera. Measured
/// at the points that the pixels' centres see, so that the largest is a lower bound of what a
/// picture of more pixels would find.
struct Popping {
  std::vector<float> px;  // a pixel each; NaN where it is not measured: nothing is seen, or was not
                          // in view of the frame before, or one frame draws nothing there
  Distribution pixels;    // of these
  double max_px = 0.0;    // in double; +inf if what was drawn lies behind the eye
  std::int64_t over_1px = 0;               // pixels
  std::optional<PoppedPlace> worst;        // nothing if nothing moved
  std::optional<PoppedVertices> vertices;  // of meshes over heights
};

/// Levels that go from one to another and back in three frames that follow one another.
struct Flicker {
  std::int64_t compared = 0;  // pixels whose point was in view of, and drawn in, all three
  std::int64_t pixels = 0;    // of them: level A, then another, then A again
  std::int64_t patches = 0;   // of the last frame, in which such pixels lie
  DrawnThere worst;           // the patch that has most of them, the first of equals
  std::int64_t worst_pixels = 0;
};

struct FrameChange {
  std::optional<Popping> popping;  // nothing of a path's first frame
  std::optional<Flicker> flicker;  // nothing of the first two, and of surfaces without levels
};

struct ChangeOptions {
  Band band;             // how far silhouettes may move; of surfaces without a mesh
  bool vertices = true;  // also at the vertices of meshes over heights
};

/// Defined by equations (15) to (18) of docs/algorithms/ground-truth.md.
///
/// now      audited with the result `audited`, whose two pictures are used
/// before   the frame before, or null: nothing is measured
/// earlier  the one before that, or null: no flicker is
///
///   (1) Where both frames draw the same, the popping is 0: a camera alone pops nothing.
///   (2) A pixel pops by no more than the sum of both frames' errors at its point, both seen by the
///       later camera: a method that keeps an error e pops by 2 e, where the camera stands still.
///   (3) The result has the same bits on any number of threads.
/// Throws std::invalid_argument if the frames are not surfaces of one kind.
FrameChange change_between(const TruthTerms& truth, const AuditResult& audited, const Frame& now,
                           const Frame* before, const Frame* earlier,
                           const ChangeOptions& options = {});

}  // namespace plumb::audit::temporal
