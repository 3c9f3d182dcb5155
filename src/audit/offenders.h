// Where an audit's worst places are, in the terms of a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audit/audit.h"

namespace plumb::audit {

/// Names places of one audit: pixel, world coordinates, sample and patch.
class OffenderFinder {
 public:
  /// Keeps references to all of them.
  OffenderFinder(const AuditResult& result, const HeightfieldTruth& truth,
                 const DrawnSurface& surface, const Camera& camera)
      : result_(result), truth_(truth), surface_(surface), camera_(camera) {}

  /// Nothing if there is no worst sample.
  std::optional<Offender> at_sample(const std::string& what, const WorstSample& worst,
                                    Unit unit) const;
  /// A place on the truth, relative to the terrain's origin.
  Offender at_place(std::string what, double value, Unit unit, const glm::dvec3& local_m,
                    std::uint32_t triangle) const;
  /// What is drawn at a pixel.
  Offender at_pixel(std::string what, double value, Unit unit, std::size_t pixel) const;
  Offender at_defect(const CoverageDefect& defect) const;

  /// Defects of coverage and the pixels that are farthest off, at most `most` of each, the worst
  /// samples, and what the topology lists.
  std::vector<Offender> worst(std::size_t most) const;

 private:
  void set_patch(Offender& o, int patch) const;

  const AuditResult& result_;
  const HeightfieldTruth& truth_;
  const DrawnSurface& surface_;
  const Camera& camera_;
};

}  // namespace plumb::audit
