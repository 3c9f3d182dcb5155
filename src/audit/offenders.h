// Where an audit's worst places are, in the terms of a report.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/truth_terms.h"

namespace plumb::audit {

/// Names places of one audit: pixel, world coordinates, sample, triangle and patch.
class OffenderFinder {
 public:
  /// Keeps references to all of them.
  OffenderFinder(const AuditResult& result, const TruthTerms& truth, const DrawnSurface& surface,
                 const Camera& camera)
      : result_(result), truth_(truth), surface_(surface), camera_(camera) {}

  /// Nothing if there is no worst sample.
  std::optional<Offender> at_sample(const std::string& what, const WorstSample& worst,
                                    Unit unit) const;
  /// A place on the truth, relative to the terrain's origin.
  Offender at_place(std::string what, double value, Unit unit, const glm::dvec3& local_m,
                    std::uint32_t triangle) const;
  /// What is drawn at a pixel.
  Offender at_pixel(std::string what, double value, Unit unit, std::size_t pixel) const;
  /// What the truth shows at a pixel.
  Offender at_true_pixel(std::string what, double value, Unit unit, std::size_t pixel) const;
  Offender at_defect(const CoverageDefect& defect) const;

  /// The first defects of coverage.
  std::vector<Offender> defects(std::size_t most) const;
  /// The pixels with the largest errors above `above`, worst first; `of_truth`: at_true_pixel.
  std::vector<Offender> pixels(const std::string& what, std::span<const float> errors, Unit unit,
                               std::size_t most, bool of_truth = false, double above = 0.0) const;
  /// What the topology lists.
  std::vector<Offender> topology_flaws() const;
  /// The samples of one kind that are listed.
  std::vector<Offender> sample_flaws(SampleFlaw::Kind kind) const;

  /// The places of broken claims, defects of coverage before all; then, as far as they are not
  /// among those, the worst samples, the pixels that are farthest off, and what topology and
  /// samples list. An error of those that the truth's rounding explains is none.
  std::vector<Offender> worst(const std::vector<ClaimResult>& claims, std::size_t most) const;

 private:
  Offender at_hit(std::string what, double value, Unit unit, const HitImage& hits,
                  std::uint32_t triangle, std::size_t pixel) const;
  void set_patch(Offender& o, int patch) const;
  double height_over(const SampleFlaw& flaw) const;

  const AuditResult& result_;
  TruthTerms truth_;
  const DrawnSurface& surface_;
  const Camera& camera_;
};

}  // namespace plumb::audit
