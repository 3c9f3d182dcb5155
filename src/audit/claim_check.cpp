#include "audit/claim_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "audit/drawn_point.h"
#include "audit/offenders.h"
#include "core/check.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

// Projecting a displacement rounds some thirty times: relative, of the measured value.
constexpr double kProjectionSlack = 64.0 * std::numeric_limits<double>::epsilon();

// Values were rounded to float32; none that was at most `bound` counts.
std::int64_t count_above(std::span<const float> values, double bound) {
  auto limit = static_cast<float>(bound);
  if (limit < bound) limit = std::nextafter(limit, std::numeric_limits<float>::infinity());
  return std::count_if(values.begin(), values.end(), [&](float value) { return value > limit; });
}

class Checker {
 public:
  Checker(AuditResult& result, const HeightfieldTruth& truth, const DrawnSurface& surface,
          const Camera& camera, const AuditOptions& options)
      : result_(result),
        truth_(truth),
        surface_(surface),
        options_(options),
        finder_(result, truth, surface, camera) {
    const double reach = parallel_ordered_reduce(
        static_cast<std::int64_t>(result.drawn.size()), 1 << 16, 0.0,
        [&](std::int64_t begin, std::int64_t end, double most) {
          for (std::int64_t k = begin; k < end; ++k) {
            most = std::max(
                most, largest_coordinate(result.drawn.from_eye_m[static_cast<std::size_t>(k)]));
          }
          return most;
        },
        [](double a, double b) { return std::max(a, b); });
    eye_slack_m_ = drawn_point_slack_m(reach);
  }

  void run() {
    std::vector<ClaimResult> of_patches;
    for (const Claim& claim : surface_.claims) {
      if (claim.scope == Scope::Frame) {
        result_.claims.push_back(judge(claim, name_of(claim.measure)));
      } else {
        check_patch(claim, of_patches);
      }
    }
    result_.claims.push_back(
        judge({Measure::Coverage, 0.0, Unit::Count}, name_of(Measure::Coverage)));
    for (const Limit& limit : options_.limits) result_.claims.push_back(judge_limit(limit));
    keep_telling(of_patches);
    result_.offenders = finder_.worst(static_cast<std::size_t>(std::max(1, options_.most_listed)));
  }

 private:
  double slack_px(double pixels_per_metre, double measured) const {
    return (truth_.slack_m + eye_slack_m_) * pixels_per_metre +
           kProjectionSlack * (std::isfinite(measured) ? measured : 0.0);
  }

  ClaimResult judge(const Claim& claim, std::string label) const {
    if (!result_.of_mesh && claim.measure != Measure::PixelError &&
        claim.measure != Measure::Coverage)
      input_error("{}: this method draws no mesh, of which it could be measured", label);
    ClaimResult r;
    r.claim = claim;
    r.label = std::move(label);
    switch (claim.measure) {
      case Measure::SampleError:
        sample_error(r, claim.bound, claim.unit);
        break;
      case Measure::SurfaceError:
        surface_error(r, claim.bound, claim.unit);
        break;
      case Measure::PixelError:
        pixel_error(r, claim.bound, claim.unit);
        break;
      case Measure::Coverage:
        coverage(r);
        break;
    }
    r.holds = !(r.measured > r.claim.bound + r.slack);
    if (!r.holds && r.violations == 0) r.violations = 1;
    if (r.holds) r.violations = 0;
    return r;
  }

  void sample_error(ClaimResult& r, double bound, Unit unit) const {
    const SampleErrors& s = result_.samples;
    if (unit == Unit::Metre) {
      r.measured = s.worst_m.error;
      r.slack = truth_.slack_m;
      r.triangles_over = 0;
      if (r.measured > bound + r.slack) {
        r.violations = count_above(s.values_m.span(), bound + r.slack);
        r.triangles_over = count_above(s.triangle_max_m, bound + r.slack);
      }
      r.worst = finder_.at_sample(r.label, s.worst_m, unit);
    } else {
      r.measured = s.worst_px.error;
      r.slack = slack_px(s.pixels_per_metre, r.measured);
      if (r.measured > bound + r.slack)
        r.violations = count_above(s.values_px.span(), bound + r.slack);
      r.worst = finder_.at_sample(r.label, s.worst_px, unit);
    }
  }

  void surface_error(ClaimResult& r, double bound, Unit unit) const {
    sample_error(r, bound, unit);
    const EdgeErrors& e = result_.edges;
    const double between = unit == Unit::Metre ? e.max_m : e.max_px;
    // Crossings may lie nearer to the eye than any sample or pixel that was measured: their own
    // scale counts.
    if (unit == Unit::Pixel) r.slack = std::max(r.slack, slack_px(e.pixels_per_metre, between));
    if (between <= r.measured) return;
    r.measured = between;
    r.worst = finder_.at_place(r.label, between, unit, unit == Unit::Metre ? e.worst_m : e.worst_px,
                               unit == Unit::Metre ? e.triangle_m : e.triangle_px);
  }

  void pixel_error(ClaimResult& r, double bound, Unit unit) const {
    const PixelErrors& p = result_.pixels;
    if (unit == Unit::Metre) {
      double most = 0.0;
      for (const float metres : p.vertical_m)
        most = std::abs(metres) > most ? std::abs(metres) : most;
      r.measured = most;
      // The map is kept in float32.
      r.slack = truth_.slack_m + most * std::numeric_limits<float>::epsilon();
      if (std::isinf(most)) r.slack = truth_.slack_m;
    } else {
      r.measured = p.max_vertical_px;
      r.slack = slack_px(p.pixels_per_metre, r.measured);
      r.violations = count_above(p.vertical_px, bound + r.slack);
    }
    if (p.worst_pixel >= 0)
      r.worst =
          finder_.at_pixel(r.label, r.measured, unit, static_cast<std::size_t>(p.worst_pixel));
  }

  void coverage(ClaimResult& r) const {
    r.measured = static_cast<double>(result_.coverage.defect_count());
    r.violations = result_.coverage.defect_count();
    if (!result_.coverage.listed.empty())
      r.worst = finder_.at_defect(result_.coverage.listed.front());
  }

  void check_patch(const Claim& claim, std::vector<ClaimResult>& kept) {
    ++result_.patch_claims;
    require(
        claim.measure == Measure::SampleError && claim.unit == Unit::Metre && claim.patch >= 0 &&
            claim.patch < static_cast<int>(result_.samples.patch_max_m.size()),
        "a patch may claim its sample error in metres, and must exist; got {} in '{}' for patch {}",
        name_of(claim.measure), name_of(claim.unit), claim.patch);
    ClaimResult r;
    r.claim = claim;
    r.label = name_of(claim.measure);
    r.measured = result_.samples.patch_max_m[static_cast<std::size_t>(claim.patch)];
    r.slack = truth_.slack_m;
    r.holds = !(r.measured > claim.bound + r.slack);
    r.violations = r.holds ? 0 : 1;
    result_.patch_claims_broken += r.violations;
    kept.push_back(std::move(r));
  }

  // Of the patches' claims a report shows those that are broken, worst first, or else the tightest.
  void keep_telling(std::vector<ClaimResult>& of_patches) {
    const auto excess = [](const ClaimResult& r) { return r.measured - r.claim.bound; };
    std::stable_sort(
        of_patches.begin(), of_patches.end(),
        [&](const ClaimResult& a, const ClaimResult& b) { return excess(a) > excess(b); });
    const auto most = static_cast<std::size_t>(std::max(1, options_.most_listed));
    for (std::size_t k = 0; k < std::min(of_patches.size(), most); ++k) {
      if (k > 0 && of_patches[k].holds) break;
      result_.claims.push_back(of_patches[k]);
    }
  }

  ClaimResult judge_limit(const Limit& limit) const {
    ClaimResult r;
    r.claim.bound = limit.bound;
    r.claim.unit = limit.unit;
    if (limit.measure == "sample-error") {
      r = judge({Measure::SampleError, limit.bound, limit.unit}, limit.measure);
    } else if (limit.measure == "surface-error") {
      r = judge({Measure::SurfaceError, limit.bound, limit.unit}, limit.measure);
    } else if (limit.measure == "pixel-error") {
      r = judge({Measure::PixelError, limit.bound, limit.unit}, limit.measure);
    } else if (limit.measure == "coverage") {
      r = judge({Measure::Coverage, limit.bound, Unit::Count}, limit.measure);
    } else if (!result_.of_mesh && limit.measure != "nearest-error") {
      input_error("{}: this method draws no mesh, of which it could be measured", limit.measure);
    } else {
      r.label = limit.measure;
      r.measured = limit.measure == "nearest-error"
                       ? std::max(result_.nearest.forward.max, result_.nearest.reverse.max)
                   : limit.measure == "reverse-pixel-error" ? result_.reverse_vertical.max
                   : limit.measure == "topology"            ? static_cast<double>(flaws())
                                                 : static_cast<double>(result_.samples.uncovered);
      r.holds = !(r.measured > limit.bound);
      r.violations = r.holds ? 0 : 1;
    }
    r.is_limit = true;
    return r;
  }

  std::int64_t flaws() const {
    const Topology& t = result_.topology;
    return t.open_edges + t.non_manifold_edges + t.non_manifold_vertices + t.degenerate_triangles +
           t.folded_triangles;
  }

  AuditResult& result_;
  const HeightfieldTruth& truth_;
  const DrawnSurface& surface_;
  const AuditOptions& options_;
  OffenderFinder finder_;
  double eye_slack_m_ = 0.0;
};

}  // namespace

void check_claims(AuditResult& result, const HeightfieldTruth& truth, const DrawnSurface& surface,
                  const Camera& camera, const AuditOptions& options) {
  Checker(result, truth, surface, camera, options).run();
}

}  // namespace plumb::audit
