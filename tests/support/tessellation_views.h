// Cameras over terrains, and the audit of what tessellation draws there.
#pragma once

#include "audit/audit.h"
#include "mesh/tessellation/tessellation.h"
#include "support/random_scene.h"

namespace plumb::test_support {

namespace tessellation = mesh::tessellation;

inline tessellation::Parameters tessellation_with(double error_m, int patch_cells,
                                                  int block_cells = 8, std::uint32_t version = 2) {
  tessellation::Parameters parameters;
  parameters.error_m = error_m;
  parameters.patch_cells = patch_cells;
  parameters.block_cells = block_cells;
  parameters.format_version = version;
  return parameters;
}

/// How far silhouettes may move: by what was asked for; where that is out of reach, by what patches
/// promise.
inline audit::Band band_of(const DrawnSurface& surface, const Tolerance& tolerance) {
  audit::Band band;
  (tolerance.unit == Unit::Pixel ? band.pixels : band.metres) = tolerance.value;
  for (const Claim& claim : surface.claims)
    if (surface.claims.front().unreachable && claim.scope == Scope::Patch)
      band.metres = std::max(band.metres, claim.bound);
  return band;
}

/// Draws one frame and holds it against the truth that a tessellator draws at full detail.
inline audit::AuditResult audit_tessellation(const audit::HeightfieldTruth& truth,
                                             const tessellation::Prepared& prepared,
                                             const Camera& camera, const Tolerance& tolerance) {
  const DrawnSurface surface = tessellation::draw(prepared, camera, tolerance);
  audit::AuditOptions options;
  options.nearest = false;
  options.band = band_of(surface, tolerance);
  return audit::audit_surface(truth, surface, camera, options);
}

/// The frame's result of a claim in a unit; null if nothing of the kind is claimed.
inline const audit::ClaimResult* frame_claim(const audit::AuditResult& result,
                                             const std::string& label) {
  for (const audit::ClaimResult& each : result.claims)
    if (each.claim.scope == Scope::Frame && each.label == label) return &each;
  return nullptr;
}

}  // namespace plumb::test_support
