// Claims and limits of the distance to the nearest point, and what else is measured both ways.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "audit/claim_measures.h"
#include "audit/over_bound.h"
#include "audit/pixel_scale.h"
#include "audit/settled_claim.h"
#include "core/check.h"

namespace plumb::audit {
namespace {

double largest_pixels_per_metre(const HitImage& hits, const Camera& camera) {
  double largest = 0.0;
  for (std::size_t pixel = 0; pixel < hits.size(); ++pixel) {
    if (hits.hit(pixel))
      largest = std::max(largest, pixels_per_metre(camera, hits.from_eye_m[pixel]));
  }
  return largest;
}

void add_largest(ClaimResult& r, std::span<const float> errors) {
  for (const float error : errors) {
    r.is_measured = r.is_measured || !std::isnan(error);
    if (error > r.measured) r.measured = error;
  }
}

}  // namespace

// Maps are kept in float32, which rounds once more.
void ClaimMeasures::nearest_error(ClaimResult& r) const {
  const NearestErrors& n = result_.nearest;
  r.is_measured = false;
  r.holds = false;
  if (!has_nearest_) return;
  constexpr double kRelative = std::numeric_limits<float>::epsilon();
  if (r.claim.unit == Unit::Pixel) {
    const double pixels = std::max(largest_pixels_per_metre(result_.drawn, camera_),
                                   largest_pixels_per_metre(result_.true_hits, camera_));
    return both_ways(r, n.forward_px, n.reverse_px, {slack_px(pixels, 0.0), kRelative});
  }
  if (result_.of_heights)
    input_error("{}: of a heightfield it is measured in px; sample-error is in m", r.label);
  for (const VertexDistances* vertices : {&n.forward_vertices, &n.reverse_vertices})
    add_largest(r, vertices->metres);
  both_ways(r, n.forward_m, n.reverse_m, {truth_.slack_m() + eye_slack_m_, kRelative});
  add_vertices(r);
}

// The surfaces out of view, where the bound is in metres.
void ClaimMeasures::add_vertices(ClaimResult& r) const {
  for (const VertexDistances* vertices :
       {&result_.nearest.forward_vertices, &result_.nearest.reverse_vertices}) {
    if (vertices->distribution.count == 0) continue;
    Offender place = finder_.at_place(r.label, vertices->distribution.max, Unit::Metre,
                                      vertices->worst_m, vertices->worst_triangle);
    if (!r.worst || place.value > r.worst->value) r.worst = place;
    const double bound = r.claim.bound + r.slack;
    if (!r.is_broken() || !(place.value > bound)) continue;
    r.violations += count_above_exactly(vertices->metres, bound);
    r.places.push_back(std::move(place));
  }
  sort_worst_first(r.places, most_);
}

// Errors of the pixels drawn and of the truth's, as their maps have them.
void ClaimMeasures::both_ways(ClaimResult& r, std::span<const float> forward,
                              std::span<const float> reverse, const MapSlack& slack) const {
  add_largest(r, forward);
  add_largest(r, reverse);
  r.slack = slack.fixed + (std::isfinite(r.measured) ? slack.relative * r.measured : 0.0);
  settle(r);
  std::vector<Offender> places = finder_.pixels(r.label, forward, r.claim.unit, most_);
  for (Offender& place : finder_.pixels(r.label, reverse, r.claim.unit, most_, true))
    places.push_back(std::move(place));
  sort_worst_first(places, most_);
  if (!places.empty()) r.worst = places.front();
  if (!r.is_broken()) return;
  const double bound = r.claim.bound + r.slack;
  r.violations = count_above_exactly(forward, bound) + count_above_exactly(reverse, bound);
  places.resize(std::min(places.size(), static_cast<std::size_t>(r.violations)));
  r.places = std::move(places);
}

}  // namespace plumb::audit
