#include "audit/audit.h"

#include "mesh/restricted_quadtree/restricted_quadtree.h"
#include "scene.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

void add(Checksum& sum, const audit::Distribution& d) {
  sum.add(d.count).add(d.infinite).add(d.max).add(d.max_finite).add(d.rms);
  sum.add(d.p50).add(d.p95).add(d.p99).add(d.p999);
}

std::uint64_t verdict() {
  const terrain::Heightfield field = mountains();
  const Camera camera = view_of(field, "oblique");
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  const DrawnSurface surface = mesh::restricted_quadtree::draw(
      mesh::restricted_quadtree::prepare(field), camera, {1.0, Unit::Pixel});
  const audit::AuditResult result = audit::audit_surface(truth, surface, camera);
  Checksum sum;
  for (const audit::Distribution* figures :
       {&result.samples.metres, &result.samples.pixels, &result.samples.visible_pixels,
        &result.vertical, &result.reverse_vertical, &result.depth, &result.normal_deg,
        &result.nearest.forward, &result.nearest.reverse})
    add(sum, *figures);
  sum.add(result.edges.max_m).add(result.edges.max_px).add(result.edges.places);
  sum.add(result.coverage.defect_count()).add(result.coverage.either);
  sum.add(std::span<const float>(result.nearest.forward_px));
  for (const audit::ClaimResult& claim : result.claims)
    sum.add(claim.measured).add(claim.slack).add(claim.violations);
  return sum.add(result.holds() ? 1 : 0).value();
}

}  // namespace

std::vector<Stage> audit_stages() { return {{"audit.verdict", verdict}}; }

}  // namespace plumb::determinism
