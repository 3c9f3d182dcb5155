// Where a pixel's point was drawn in consecutive frames. Not for users of the library.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "audit/temporal/frame_change.h"

namespace plumb::audit::temporal {

/// The frames that are compared; `earlier` may be null.
struct Frames {
  const Frame& now;
  const Frame& before;
  const Frame* earlier;
};

/// One entry a pixel of the frame `now`, row by row.
struct ChangeMaps {
  std::vector<float> px;                            // NaN where popping is not measured
  std::vector<float> m;                             // the same in metres
  std::vector<std::uint32_t> now, before, earlier;  // primitives; kNoPrimitive where none is
  std::int64_t worst_pixel = -1;                    // the first of equals
  double max_px = 0.0, max_m = 0.0;                 // there, in double
  glm::dvec3 worst_m{0.0};                          // its true point, world coordinates

  explicit ChangeMaps(std::size_t pixels);
};

/// One pixel's entry of `px` and `m`, in double; below 0: not measured.
struct Moved {
  double px = -1.0, m = -1.0;
};

/// Fills in `px`, `m` and what is worst, all but `worst_m`, from an entry a pixel.
void set_moved(ChangeMaps& maps, const std::vector<Moved>& moved);

/// By the heights that both meshes draw over the truth's point.
ChangeMaps heights_moved(const HeightfieldTruth& truth, const HitImage& true_hits,
                         const Frames& frames);
/// The same over the vertices of both meshes.
PoppedVertices vertices_moved(const HeightfieldTruth& truth, const Frames& frames);
/// By the points of both meshes that are nearest to the truth's.
ChangeMaps nearest_moved(const MeshTruth& truth, const HitImage& true_hits, const Frames& frames);
/// By the true points above or below what a pixel shows of both surfaces.
ChangeMaps shown_moved(const HeightfieldTruth& truth, const AuditResult& audited,
                       const Frames& frames, const Band& band);

/// The camera has the point, in its own coordinates, in its picture.
bool in_view(const Camera& camera, const glm::dvec3& point_m);

}  // namespace plumb::audit::temporal
