#include "audit/claim_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace plumb::audit {
namespace {

// Projecting a displacement rounds some thirty times: relative, of the measured value.
constexpr double kProjectionSlack = 64.0 * std::numeric_limits<double>::epsilon();

// Values were rounded to float32; none that was at most `bound` counts.
std::int64_t count_above(const std::vector<float>& values, double bound) {
  auto limit = static_cast<float>(bound);
  if (limit < bound) limit = std::nextafter(limit, std::numeric_limits<float>::infinity());
  return std::count_if(values.begin(), values.end(), [&](float value) { return value > limit; });
}

class Checker {
 public:
  Checker(AuditResult& result, const HeightfieldTruth& truth, const DrawnSurface& surface,
          const Camera& camera, const AuditOptions& options)
      : result_(result), truth_(truth), surface_(surface), camera_(camera), options_(options) {
    // A drawn point is a sum of the eye and a ray, rounded at their length a few times over.
    double reach = 0.0;
    for (const glm::dvec3& ray : result.drawn.from_eye_m) {
      reach = std::max({reach, std::abs(ray.x), std::abs(ray.y), std::abs(ray.z)});
    }
    eye_slack_m_ = 8.0 * std::numeric_limits<double>::epsilon() * reach;
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
    list_offenders();
  }

 private:
  double slack_px(double pixels_per_metre, double measured) const {
    return (truth_.slack_m + eye_slack_m_) * pixels_per_metre +
           kProjectionSlack * (std::isfinite(measured) ? measured : 0.0);
  }

  ClaimResult judge(const Claim& claim, std::string label) const {
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
      r.violations = count_above(s.values_m, bound + r.slack);
      r.triangles_over = count_above(s.triangle_max_m, bound + r.slack);
      r.worst = at_sample(r.label, s.worst_m, unit);
    } else {
      r.measured = s.worst_px.error;
      r.slack = slack_px(s.pixels_per_metre, r.measured);
      r.violations = count_above(s.values_px, bound + r.slack);
      r.worst = at_sample(r.label, s.worst_px, unit);
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
    r.worst = at_place(r.label, between, unit, unit == Unit::Metre ? e.worst_m : e.worst_px,
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
      r.worst = at_pixel(r.label, r.measured, unit, static_cast<std::size_t>(p.worst_pixel));
  }

  void coverage(ClaimResult& r) const {
    r.measured = static_cast<double>(result_.coverage.defect_count());
    r.violations = result_.coverage.defect_count();
    if (!result_.coverage.listed.empty()) r.worst = at_defect(result_.coverage.listed.front());
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

  Offender named(std::string what, double value, Unit unit, const glm::dvec3& local_m,
                 std::uint32_t triangle) const {
    Offender o{std::move(what), value, unit};
    o.world_m = truth_.field().world_origin_m() + local_m;
    if (triangle != kNoPrimitive) set_patch(o, patch_of(surface_, triangle));
    const glm::dvec3 view = to_view(camera_, o.world_m);
    if (view.z > 0.0) {
      const glm::dvec2 pixel = view_to_pixel(camera_, view);
      const bool inside = pixel.x >= 0.0 && pixel.x < camera_.width_px && pixel.y >= 0.0 &&
                          pixel.y < camera_.height_px;
      if (inside) {
        o.x = static_cast<int>(pixel.x);
        o.y = static_cast<int>(pixel.y);
      }
    }
    return o;
  }

  void set_patch(Offender& o, int patch) const {
    if (patch < 0 || patch >= static_cast<int>(surface_.patches.size())) return;
    o.patch = patch;
    o.patch_name = surface_.patches[static_cast<std::size_t>(patch)].name;
  }

  std::optional<Offender> at_sample(const std::string& what, const WorstSample& worst,
                                    Unit unit) const {
    if (worst.i < 0) return std::nullopt;
    const terrain::Heightfield& field = truth_.field();
    Offender o =
        named(what, worst.error, unit,
              {worst.i * field.dx_m, worst.j * field.dy_m, field.heights_m(worst.i, worst.j)},
              worst.triangle);
    o.sample_i = worst.i;
    o.sample_j = worst.j;
    return o;
  }

  Offender at_place(const std::string& what, double value, Unit unit, const glm::dvec3& local_m,
                    std::uint32_t triangle) const {
    return named(what, value, unit, local_m, triangle);
  }

  Offender at_pixel(const std::string& what, double value, Unit unit, std::size_t pixel) const {
    const HitImage& drawn = result_.drawn;
    const glm::dvec3 local =
        camera_.eye_m - truth_.field().world_origin_m() + drawn.from_eye_m[pixel];
    Offender o = named(what, value, unit, local, drawn.primitive[pixel]);
    o.x = static_cast<int>(pixel % static_cast<std::size_t>(drawn.width_px));
    o.y = static_cast<int>(pixel / static_cast<std::size_t>(drawn.width_px));
    return o;
  }

  Offender at_defect(const CoverageDefect& defect) const {
    Offender o{name_of(defect.kind), 1.0, Unit::Count, defect.x, defect.y};
    const std::size_t pixel = result_.drawn.index(defect.x, defect.y);
    const glm::dvec3 ray = defect.kind == DefectKind::Overshoot
                               ? result_.drawn.from_eye_m[pixel]
                               : result_.true_hits.from_eye_m[pixel];
    o.world_m = camera_.eye_m + ray;
    set_patch(o, defect.patch_a);
    if (defect.patch_b >= 0 && defect.patch_b < static_cast<int>(surface_.patches.size())) {
      o.patch_name += " | " + surface_.patches[static_cast<std::size_t>(defect.patch_b)].name;
    }
    return o;
  }

  void list_offenders() {
    const auto most = static_cast<std::size_t>(std::max(1, options_.most_listed));
    for (const CoverageDefect& defect : result_.coverage.listed) {
      if (result_.offenders.size() >= most) break;
      result_.offenders.push_back(at_defect(defect));
    }
    if (const auto o = at_sample("sample-error", result_.samples.worst_px, Unit::Pixel))
      result_.offenders.push_back(*o);
    if (const auto o = at_sample("sample-error", result_.samples.worst_m, Unit::Metre))
      result_.offenders.push_back(*o);
    std::vector<std::pair<float, std::size_t>> pixels;
    const auto& errors = result_.pixels.vertical_px;
    for (std::size_t pixel = 0; pixel < errors.size(); ++pixel) {
      if (errors[pixel] > 0.0f) pixels.emplace_back(errors[pixel], pixel);
    }
    const std::size_t count = std::min(pixels.size(), most);
    std::partial_sort(pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(count),
                      pixels.end(), [](const auto& a, const auto& b) {
                        return a.first != b.first ? a.first > b.first : a.second < b.second;
                      });
    for (std::size_t k = 0; k < count; ++k) {
      result_.offenders.push_back(
          at_pixel("pixel-error", pixels[k].first, Unit::Pixel, pixels[k].second));
    }
    for (const TopologyFlaw& flaw : result_.topology.listed) {
      Offender o = named(flaw.kind, 1.0, Unit::Count, flaw.at_m, flaw.triangle);
      result_.offenders.push_back(std::move(o));
    }
  }

  AuditResult& result_;
  const HeightfieldTruth& truth_;
  const DrawnSurface& surface_;
  const Camera& camera_;
  const AuditOptions& options_;
  double eye_slack_m_ = 0.0;
};

}  // namespace

void check_claims(AuditResult& result, const HeightfieldTruth& truth, const DrawnSurface& surface,
                  const Camera& camera, const AuditOptions& options) {
  Checker(result, truth, surface, camera, options).run();
}

}  // namespace plumb::audit
