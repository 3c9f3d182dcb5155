#include "audit/claim_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "audit/drawn_point.h"
#include "audit/mesh_edges.h"
#include "audit/over_bound.h"
#include "audit/settled_claim.h"
#include "core/check.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

// Projecting a displacement rounds some thirty times: relative, of the measured value.
constexpr double kProjectionSlack = 64.0 * std::numeric_limits<double>::epsilon();

std::vector<float> magnitudes(const std::vector<float>& values) {
  std::vector<float> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(),
                 [](float value) { return std::abs(value); });
  return result;
}

double projection_slack_px(double measured) {
  return kProjectionSlack * (std::isfinite(measured) ? measured : 0.0);
}

std::int64_t flaws_of(const Topology& t) {
  return t.open_edges + t.non_manifold_edges + t.non_manifold_vertices + t.degenerate_triangles +
         t.folded_triangles;
}

}  // namespace

ClaimMeasures::ClaimMeasures(const AuditResult& result, const TruthTerms& truth,
                             const DrawnSurface& surface, const Camera& camera,
                             const AuditOptions& options)
    : result_(result),
      truth_(truth),
      surface_(surface),
      camera_(camera),
      has_nearest_(options.nearest),
      most_(static_cast<std::size_t>(std::max(1, options.most_listed))),
      finder_(result, truth, surface, camera) {
  const double reach = parallel_ordered_reduce(
      static_cast<std::int64_t>(result.drawn.size()), 1 << 16, 0.0,
      [&](std::int64_t begin, std::int64_t end, double most) {
        for (std::int64_t k = begin; k < end; ++k) {
          most = std::max(most,
                          largest_coordinate(result.drawn.from_eye_m[static_cast<std::size_t>(k)]));
        }
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
  eye_slack_m_ = drawn_point_slack_m(reach);
}

double ClaimMeasures::slack_px(double pixels_per_metre, double measured) const {
  return (truth_.slack_m() + eye_slack_m_) * pixels_per_metre + projection_slack_px(measured);
}

double ClaimMeasures::vertical_slack_m() const {
  return truth_.slack_m() + eye_slack_m_ * (1.0 + truth_.heights()->steepest_slope);
}

// Above and below a terrain of stacks there may be several surfaces.
void ClaimMeasures::require_heights(const std::string& label) const {
  if (result_.of_heights) return;
  input_error("{}: of a terrain of stacks it is not measured; nearest-error is, in px and in m",
              label);
}

ClaimResult ClaimMeasures::of_claim(const Claim& claim, std::string label) const {
  if (!result_.of_mesh && claim.measure != Measure::PixelError &&
      claim.measure != Measure::Coverage)
    input_error("{}: only of a mesh could it be measured, and here is none", label);
  if (claim.measure == Measure::SampleError || claim.measure == Measure::SurfaceError ||
      claim.measure == Measure::PixelError)
    require_heights(label);
  ClaimResult r;
  r.claim = claim;
  r.label = std::move(label);
  switch (claim.measure) {
    case Measure::SampleError:
      sample_error(r);
      break;
    case Measure::SurfaceError:
      surface_error(r);
      break;
    case Measure::PixelError:
      pixel_error(r);
      break;
    case Measure::Coverage:
      coverage(r);
      break;
    case Measure::NearestError:
      nearest_error(r);
      break;
  }
  return r;
}

void ClaimMeasures::measure_samples(ClaimResult& r) const {
  const SampleErrors& s = result_.samples;
  const bool metres = r.claim.unit == Unit::Metre;
  const WorstSample& worst = metres ? s.worst_m : s.worst_px;
  r.is_measured = (metres ? s.metres : s.pixels).count > 0;
  r.measured = worst.error;
  r.slack = metres ? truth_.slack_m() : slack_px(s.pixels_per_metre, r.measured);
  r.worst = finder_.at_sample(r.label, worst, r.claim.unit);
  if (metres) r.triangles_over = 0;
}

// Where samples are over the bound: how many, and the worst.
void ClaimMeasures::add_samples_over(ClaimResult& r) const {
  const SampleErrors& s = result_.samples;
  const bool metres = r.claim.unit == Unit::Metre;
  const WorstSample& worst = metres ? s.worst_m : s.worst_px;
  const double bound = r.claim.bound + r.slack;
  if (!(worst.error > bound)) return;
  r.violations += count_above((metres ? s.values_m : s.values_px).span(), bound);
  if (metres) r.triangles_over = count_above(s.triangle_max_m, bound);
  r.places.push_back(*finder_.at_sample(r.label, worst, r.claim.unit));
}

void ClaimMeasures::sample_error(ClaimResult& r) const {
  measure_samples(r);
  add_samples_over(r);
  settle(r);
}

void ClaimMeasures::surface_error(ClaimResult& r) const {
  measure_samples(r);
  const EdgeErrors& e = result_.edges;
  const bool metres = r.claim.unit == Unit::Metre;
  const double between = metres ? e.max_m : e.max_px;
  // Crossings may lie nearer to the eye than any sample or pixel that was measured: their own
  // scale counts.
  if (!metres) r.slack = std::max(r.slack, slack_px(e.pixels_per_metre, between));
  if (between > r.measured) {
    r.measured = between;
    r.worst = finder_.at_place(r.label, between, r.claim.unit, metres ? e.worst_m : e.worst_px,
                               metres ? e.triangle_m : e.triangle_px);
  }
  r.is_measured = r.is_measured || (metres ? e.places > 0 : any_place_in_view());
  settle(r);
  if (!r.is_broken()) return;
  add_samples_over(r);
  if (between > r.claim.bound + r.slack) add_places_over(r);
  sort_worst_first(r.places, most_);
}

EdgePlacesOver ClaimMeasures::places_over(const Tolerance& bound, std::size_t most) const {
  const TriangleMesh& mesh = *surface_.mesh;
  return edge_places_over(*truth_.heights(), mesh, MeshEdges(mesh), camera_, bound, most);
}

// Places between the samples are kept by none: they are gone through again.
void ClaimMeasures::add_places_over(ClaimResult& r) const {
  const EdgePlacesOver over = places_over({r.claim.bound + r.slack, r.claim.unit}, most_);
  r.violations += over.count;
  for (const EdgePlace& place : over.worst)
    r.places.push_back(
        finder_.at_place(r.label, place.error, r.claim.unit, place.at_m, place.triangle));
}

bool ClaimMeasures::any_place_in_view() const {
  if (result_.edges.max_px > 0.0) return true;
  return result_.vertical.count > 0 && places_over({-1.0, Unit::Pixel}, 0).count > 0;
}

void ClaimMeasures::pixel_error(ClaimResult& r) const {
  const PixelErrors& p = result_.pixels;
  r.is_measured = result_.vertical.count > 0;
  if (r.claim.unit == Unit::Metre) return pixel_error_m(r);
  r.measured = p.max_vertical_px;
  r.slack = vertical_slack_m() * p.pixels_per_metre + projection_slack_px(r.measured);
  if (p.worst_pixel >= 0)
    r.worst = finder_.at_pixel(r.label, r.measured, r.claim.unit,
                               static_cast<std::size_t>(p.worst_pixel));
  settle(r);
  if (!r.is_broken()) return;
  r.violations = count_above(p.vertical_px, r.claim.bound + r.slack);
  r.places = worst_pixels_over(r, p.vertical_px);
}

// The map is kept in float32, and what is measured is its largest.
void ClaimMeasures::pixel_error_m(ClaimResult& r) const {
  const std::vector<float> metres = magnitudes(result_.pixels.vertical_m);
  const std::vector<Offender> farthest = finder_.pixels(r.label, metres, r.claim.unit, 1);
  if (!farthest.empty()) {
    r.worst = farthest.front();
    r.measured = farthest.front().value;
  }
  r.slack = vertical_slack_m();
  if (std::isfinite(r.measured)) r.slack += r.measured * std::numeric_limits<float>::epsilon();
  settle(r);
  if (!r.is_broken()) return;
  r.violations = count_above_exactly(metres, r.claim.bound + r.slack);
  r.places = worst_pixels_over(r, metres);
}

std::vector<Offender> ClaimMeasures::worst_pixels_over(const ClaimResult& r,
                                                       std::span<const float> errors) const {
  const auto most = std::min(most_, static_cast<std::size_t>(r.violations));
  return finder_.pixels(r.label, errors, r.claim.unit, most);
}

// Where neither the truth nor the picture shows anything, no pixel can be wrong.
bool ClaimMeasures::anything_in_view() const {
  for (std::size_t pixel = 0; pixel < result_.drawn.size(); ++pixel) {
    const bool judged = result_.set_aside.empty() || result_.set_aside[pixel] == 0;
    if (judged && (result_.true_hits.hit(pixel) || result_.drawn.hit(pixel))) return true;
  }
  return false;
}

void ClaimMeasures::coverage(ClaimResult& r) const {
  const Coverage& c = result_.coverage;
  r.is_measured = c.must_be_terrain > 0 || (c.must_be_sky > 0 && anything_in_view());
  count_defects(r, c.defect_count(), finder_.defects(most_));
}

void ClaimMeasures::count_defects(ClaimResult& r, std::int64_t defects,
                                  std::vector<Offender> places) const {
  r.measured = static_cast<double>(defects);
  settle(r);
  if (!places.empty()) r.worst = places.front();
  if (!r.is_broken()) return;
  r.violations = beyond(defects, r.claim.bound);
  r.places = std::move(places);
}

ClaimResult ClaimMeasures::of_limit(const Limit& limit) const {
  if (limit.measure == "popping")
    input_error(
        "limit popping: it is measured between the frames of a path, and this is one frame");
  ClaimResult r;
  r.claim.bound = limit.bound;
  r.claim.unit = limit.unit;
  if (limit.measure == "sample-error") {
    r = of_claim({Measure::SampleError, limit.bound, limit.unit}, limit.measure);
  } else if (limit.measure == "surface-error") {
    r = of_claim({Measure::SurfaceError, limit.bound, limit.unit}, limit.measure);
  } else if (limit.measure == "pixel-error") {
    r = of_claim({Measure::PixelError, limit.bound, limit.unit}, limit.measure);
  } else if (limit.measure == "coverage") {
    r = of_claim({Measure::Coverage, limit.bound, Unit::Count}, limit.measure);
  } else if (!result_.of_mesh && limit.measure != "nearest-error") {
    input_error("{}: only of a mesh could it be measured, and here is none", limit.measure);
  } else {
    r.label = limit.measure;
    of_limit_alone(r);
  }
  r.is_limit = true;
  return r;
}

// What only a limit names.
void ClaimMeasures::of_limit_alone(ClaimResult& r) const {
  if (r.label == "topology") {
    r.is_measured = result_.topology.triangles > 0;
    count_defects(r, flaws_of(result_.topology), finder_.topology_flaws());
  } else if (r.label == "uncovered-samples") {
    require_heights(r.label);
    const SampleErrors& s = result_.samples;
    r.is_measured = s.metres.count + s.uncovered > 0;
    count_defects(r, s.uncovered, finder_.sample_flaws(SampleFlaw::Kind::Uncovered));
  } else if (r.label == "reverse-pixel-error") {
    require_heights(r.label);
    r.is_measured = false;
    both_ways(r, {}, result_.reverse_pixels.vertical_px, {});
  } else {
    if (!has_nearest_)
      input_error("limit nearest-error: the distances to nearest points are left out");
    nearest_error(r);
  }
}

}  // namespace plumb::audit
