// One claim or limit against what was measured.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/offenders.h"

namespace plumb::audit {

/// Fills in a ClaimResult for each measure: what was measured, whether anything was, and, where the
/// bound is broken, how often and where.
class ClaimMeasures {
 public:
  /// Keeps references to all of them; the measures in `result` are there already.
  ClaimMeasures(const AuditResult& result, const TruthTerms& truth, const DrawnSurface& surface,
                const Camera& camera, const AuditOptions& options);

  /// Throws InputError if the surface, or the truth, has not what is measured.
  ClaimResult of_claim(const Claim& claim, std::string label) const;
  ClaimResult of_limit(const Limit& limit) const;

  /// The truth or the picture shows something that is judged.
  bool anything_in_view() const;
  const OffenderFinder& finder() const { return finder_; }
  std::size_t most_places() const { return most_; }  // of a claim

 private:
  double slack_px(double pixels_per_metre, double measured) const;
  /// Of a vertical distance at a point that a picture shows: how far that is off, and by how much
  /// the ground rises on that way.
  double vertical_slack_m() const;
  void measure_samples(ClaimResult& r) const;
  void add_samples_over(ClaimResult& r) const;
  void add_places_over(ClaimResult& r) const;
  EdgePlacesOver places_over(const Tolerance& bound, std::size_t most) const;
  bool any_place_in_view() const;
  std::vector<Offender> worst_pixels_over(const ClaimResult& r,
                                          std::span<const float> errors) const;
  void count_defects(ClaimResult& r, std::int64_t defects, std::vector<Offender> places) const;
  void sample_error(ClaimResult& r) const;
  void surface_error(ClaimResult& r) const;
  void pixel_error(ClaimResult& r) const;
  void pixel_error_m(ClaimResult& r) const;
  void coverage(ClaimResult& r) const;
  void of_limit_alone(ClaimResult& r) const;
  void nearest_error(ClaimResult& r) const;
  void add_vertices(ClaimResult& r) const;
  /// What rounding may add to a map's errors: so much, and a part of each.
  struct MapSlack {
    double fixed = 0.0, relative = 0.0;
  };
  void both_ways(ClaimResult& r, std::span<const float> forward, std::span<const float> reverse,
                 const MapSlack& slack) const;
  void require_heights(const std::string& label) const;

  const AuditResult& result_;
  TruthTerms truth_;
  const DrawnSurface& surface_;
  const Camera& camera_;
  bool has_nearest_;
  std::size_t most_;
  OffenderFinder finder_;
  double eye_slack_m_ = 0.0;
};

}  // namespace plumb::audit
