// The audit of a drawn heightfield: every measure, every claim, one verdict.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audit/coverage.h"
#include "audit/distribution.h"
#include "audit/edge_error.h"
#include "audit/method.h"
#include "audit/pixel_error.h"
#include "audit/registration.h"
#include "audit/sample_error.h"
#include "audit/topology.h"
#include "audit/truth.h"
#include "audit/vertex_distances.h"
#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// A bound that the user sets, judged beside the method's own claims.
struct Limit {
  std::string measure;  // see limit_measures()
  double bound = 0.0;
  Unit unit = Unit::Pixel;
};

/// "pixel-error=1px", "sample-error=5m", "coverage=0". Throws InputError naming the measures that
/// there are.
Limit parse_limit(const std::string& text);

struct AuditOptions {
  std::vector<Limit> limits;
  Band band;             // how far silhouettes may move: the tolerance asked for
  bool nearest = true;   // also the distance to the nearest point, both ways
  int most_listed = 20;  // worst offenders and flaws of a kind
};

/// Errors to the nearest point of the other surface, projected. They are no screen distances, and
/// judge nothing that does not claim them.
struct NearestErrors {
  std::vector<float> forward_px;  // a pixel each: from the point drawn; NaN where nothing is
  std::vector<float> reverse_px;  // from the truth's; empty for a surface without a mesh
  Distribution forward, reverse;
  /// Of a truth that is no heightfield, else empty: the distances themselves, and those of the
  /// vertices of both surfaces, in view or not.
  std::vector<float> forward_m, reverse_m;
  Distribution forward_metres, reverse_metres;
  std::vector<std::uint32_t> reverse_triangle;  // that holds the nearest drawn point; a pixel each
  VertexDistances forward_vertices, reverse_vertices;
};

/// A place worth looking at.
struct Offender {
  std::string what;  // the measure, or what is there: "hole", "open edge", "uncovered sample"
  double value = 0.0;
  Unit unit = Unit::Pixel;
  int x = -1, y = -1;  // pixel; -1 if out of view
  int sample_i = -1, sample_j = -1;
  glm::dvec3 world_m{0.0};
  int patch = -1;
  std::string patch_name = {};
  std::uint32_t triangle = kNoPrimitive;  // of the mesh
  std::string breaks = {};  // label of the claim that is broken there; empty if none is
};

enum class Verdict {
  Held,
  Broken,
  None,  // nothing was measured
};
const char* name_of(Verdict verdict);  // "held", "broken", "none"

struct ClaimResult {
  Claim claim;
  bool is_limit = false;  // the user's, not the method's
  std::string label;      // "sample-error", "coverage", ...
  double measured = 0.0;
  double slack = 0.0;  // what rounding may add to the measurement, in the claim's unit
  /// How many samples, places between samples or pixels are over the bound; of a measure that is
  /// itself a count, how many defects there are beyond it.
  std::int64_t violations = 0;
  std::int64_t triangles_over =
      -1;  // drawn triangles that cover a sample over it; -1 where that is not counted
  bool is_measured = true;  // false: there was nothing to measure, and nothing is `measured`
  bool holds = true;        // is measured, and not over the bound
  std::optional<Offender> worst;
  std::vector<Offender>
      places;  // where it is broken: the worst, or the first, at most `most_listed`

  bool is_broken() const { return is_measured && !holds; }
  Verdict verdict() const {
    return holds ? Verdict::Held : is_measured ? Verdict::Broken : Verdict::None;
  }
  /// Claimed divided by measured: 1 is tight, 2 twice as careful as needed, below 1 broken. Nothing
  /// where both are zero, or nothing is measured.
  std::optional<double> tightness() const;
};

struct AuditTimes {
  double prepare_s = 0.0, draw_s = 0.0, raster_s = 0.0, truth_s = 0.0, measure_s = 0.0;
};

struct AuditResult {
  HitImage true_hits, drawn;
  /// False for a surface without a mesh: only `pixels`, `vertical`, `depth`, `nearest.forward`,
  /// `coverage` and where the points are seen are measured of it.
  bool of_mesh = true;
  bool of_solid = false;  // without a mesh: see DrawnSurface::is_solid
  /// False: the truth is a mesh that is no heightfield (solid_audit.h). `samples`, `edges`,
  /// `pixels`, `reverse_pixels` and what is vertical are not measured then, and empty.
  bool of_heights = true;
  /// Pixels that are not judged, 1 each (set_aside.h), and how many; empty but for a solid.
  std::vector<std::uint8_t> set_aside;
  std::int64_t pixels_set_aside = 0;
  SampleErrors samples;
  EdgeErrors edges;
  PixelErrors pixels;
  ReversePixelErrors reverse_pixels;
  Distribution vertical, reverse_vertical, depth, normal_deg;
  NearestErrors nearest;
  Coverage coverage;
  Registration registration;
  Topology topology;
  std::vector<ClaimResult>
      claims;  // frame claims first, then those of patches: only the broken and the tightest ones
  std::int64_t patch_claims = 0;  // of the method: those that could be measured, all of them judged
  std::int64_t patch_claims_broken = 0;
  /// What broke comes first, claim by claim, defects of coverage before all; then the worst of
  /// every other measure. Errors of zero, or of what rounding explains, are none.
  std::vector<Offender> offenders;
  std::string no_verdict;  // why there is none, if no claim of the frame and no limit was measured
  Cost cost;
  AuditTimes times;

  /// Broken if a claim or a limit is, of the frame or of a patch, or the picture does not belong to
  /// the camera. Else held if a claim of the frame or a limit could be measured. Else there is
  /// none: patches' claims say how the mesh was made, and nothing of the frame.
  Verdict verdict() const;
  /// The verdict is Held.
  bool holds() const { return verdict() == Verdict::Held; }
};

/// Judges a surface and the picture that was drawn of it.
///
/// truth    the full-detail surface; its cast_frame(camera) is `true_hits`
/// drawn    what the surface looks like through `camera`, by whatever renderer; `primitive` indexes
///          the surface's triangles (patches, where it has no mesh)
/// The result has the same bits on every machine and number of threads, `times` apart.
AuditResult audit_picture(const HeightfieldTruth& truth, HitImage true_hits,
                          const DrawnSurface& surface, HitImage drawn, const Camera& camera,
                          const AuditOptions& options = {});

/// Casts the truth, draws the surface (a mesh with the rasteriser) and judges it.
AuditResult audit_surface(const HeightfieldTruth& truth, const DrawnSurface& surface,
                          const Camera& camera, const AuditOptions& options = {});

}  // namespace plumb::audit
