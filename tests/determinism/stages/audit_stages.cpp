#include <memory>
#include <utility>

#include "audit/audit.h"
#include "audit/picture.h"
#include "audit/solid_audit.h"
#include "raster/rasteriser.h"
#include "scene.h"
#include "stage.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::determinism {
namespace {

using audit::AuditResult;

constexpr Tolerance kTolerance{2.0, Unit::Pixel};

DrawnSurface drawn(const terrain::Heightfield& field, const Camera& camera) {
  const audit::Method& method =
      audit::find_method(audit::built_in_methods(), "restricted-quadtree");
  return audit::prepare_method(method, field, {"", {{"patch_cells", "16"}}}, kTolerance)
      ->draw(camera, kTolerance);
}

// One triangle gone and one corner raised: an audit that has something to find.
DrawnSurface damaged(DrawnSurface surface) {
  TriangleMesh mesh = *surface.mesh;
  mesh.vertices_m[mesh.vertices_m.size() / 2].z += 60.0;
  mesh.triangles[mesh.triangles.size() / 3] = mesh.triangles[mesh.triangles.size() / 3 - 1];
  surface.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return surface;
}

void add_distribution(Checksum& sum, const audit::Distribution& d) {
  sum.add(d.count).add(d.infinite).add(d.max).add(d.max_finite).add(d.rms);
  sum.add(d.p50).add(d.p95).add(d.p99).add(d.p999);
}

void add_measures(Checksum& sum, const AuditResult& result) {
  add_distribution(sum, result.samples.metres);
  add_distribution(sum, result.samples.pixels);
  add_distribution(sum, result.samples.visible_pixels);
  add_distribution(sum, result.vertical);
  add_distribution(sum, result.reverse_vertical);
  add_distribution(sum, result.depth);
  add_distribution(sum, result.normal_deg);
  add_distribution(sum, result.nearest.forward);
  add_distribution(sum, result.nearest.reverse);
  sum.add(std::span<const float>(result.samples.triangle_max_m));
  sum.add(std::span<const float>(result.pixels.vertical_px));
  sum.add(std::span<const float>(result.nearest.forward_px));
  sum.add(result.edges.max_m).add(result.edges.max_px).add(result.edges.places);
}

void add_coverage(Checksum& sum, const AuditResult& result) {
  const audit::Coverage& c = result.coverage;
  sum.add(c.must_be_terrain).add(c.must_be_sky).add(c.either);
  sum.add(c.holes).add(c.overshoots).add(c.see_through);
  for (const audit::DefectKind defect : c.defects) sum.add(static_cast<int>(defect));
  const audit::Topology& t = result.topology;
  sum.add(t.boundary_edges).add(t.open_edges).add(t.t_junctions).add(t.non_manifold_edges);
  sum.add(t.degenerate_triangles).add(t.folded_triangles).add(t.overlapped_samples);
  for (const audit::TopologyFlaw& flaw : t.listed) {
    sum.add(std::string_view(flaw.kind)).add(flaw.triangle).add(flaw.patch);
    add(sum, flaw.at_m);
  }
  const audit::Registration& r = result.registration;
  sum.add(r.mean_shift_px.x).add(r.mean_shift_px.y).add(r.largest_shift_px);
  add(sum, r.eye_offset_m);
}

void add_claims(Checksum& sum, const AuditResult& result) {
  for (const audit::ClaimResult& claim : result.claims) {
    sum.add(std::string_view(claim.label)).add(claim.measured).add(claim.slack);
    sum.add(claim.violations).add(claim.triangles_over).add(claim.holds ? 1 : 0);
  }
  for (const audit::Offender& offender : result.offenders) {
    sum.add(std::string_view(offender.what)).add(offender.value).add(offender.x).add(offender.y);
    add(sum, offender.world_m);
  }
  sum.add(result.patch_claims).add(result.patch_claims_broken).add(result.holds() ? 1 : 0);
}

std::uint64_t whole_audit(bool sound) {
  const terrain::Heightfield field = hills();
  const Camera camera = camera_for(field, "oblique");
  const DrawnSurface surface = drawn(field, camera);
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  audit::AuditOptions options;
  options.band.pixels = kTolerance.value;
  const AuditResult result =
      audit::audit_surface(truth, sound ? surface : damaged(surface), camera, options);
  Checksum sum;
  add_measures(sum, result);
  add_coverage(sum, result);
  add_claims(sum, result);
  return sum.value();
}

// Caves by coarse nodes, held against their finest level.
std::uint64_t audit_of_stacks() {
  // Not by terrain_source.h, which brings every reader of files with it.
  auto stacks = std::make_shared<const terrain::StackField>(
      terrain::generate_stacks("generate:caves?size=33&spacing=8"));
  terrain::Heightfield field = terrain::top_surface(*stacks);
  field.stacks = std::move(stacks);
  const Camera camera = camera_for(field, "oblique");
  constexpr Tolerance kCoarse{60.0, Unit::Pixel};
  const audit::MethodTable& table = audit::built_in_methods();
  const DrawnSurface surface =
      audit::prepare_method(audit::find_method(table, "stacks"), field, {"published", {}}, kCoarse)
          ->draw(camera, kCoarse);
  const audit::MeshTruth truth(field, audit::full_detail_of_stacks(table, field));
  const AuditResult result = audit::audit_surface(truth, surface, camera);
  Checksum sum;
  add_measures(sum, result);
  for (const std::vector<float>* map :
       {&result.nearest.reverse_px, &result.nearest.forward_m, &result.nearest.reverse_m,
        &result.nearest.forward_vertices.metres, &result.nearest.reverse_vertices.metres})
    sum.add(std::span<const float>(*map));
  sum.add(result.topology.self_intersections);
  add_coverage(sum, result);
  add_claims(sum, result);
  return sum.value();
}

// Every channel of both kinds of picture, as golden cases sum them up.
std::uint64_t pictures() {
  const terrain::Heightfield field = hills();
  const Camera camera = camera_for(field, "valley");
  const DrawnSurface surface = drawn(field, camera);
  const HitImage hits = raster::rasterise(*surface.mesh, camera).image;
  const reference::PyramidCaster caster(field, terrain::Diagonal::Alternating);
  Checksum sum;
  sum.add(image::raw_checksum(audit::draw_picture(field, hits, surface, camera, {})));
  sum.add(
      image::raw_checksum(audit::draw_truth_picture(field, caster.cast_frame(camera), camera, {})));
  return sum.value();
}

}  // namespace

std::vector<Stage> audit_stages() {
  return {{"audit.of_a_sound_surface", [] { return whole_audit(true); }},
          {"audit.of_a_damaged_surface", [] { return whole_audit(false); }},
          {"audit.of_stacks", audit_of_stacks},
          {"audit.pictures", pictures}};
}

}  // namespace plumb::determinism
