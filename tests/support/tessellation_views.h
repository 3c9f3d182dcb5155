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

/// Draws one frame and holds it against the truth that a tessellator draws at full detail.
inline audit::AuditResult audit_tessellation(const audit::HeightfieldTruth& truth,
                                             const tessellation::Prepared& prepared,
                                             const Camera& camera, const Tolerance& tolerance) {
  audit::AuditOptions options;
  options.nearest = false;
  (tolerance.unit == Unit::Pixel ? options.band.pixels : options.band.metres) = tolerance.value;
  return audit::audit_surface(truth, tessellation::draw(prepared, camera, tolerance), camera,
                              options);
}

/// The frame's result of a claim in a unit; null if nothing of the kind is claimed.
inline const audit::ClaimResult* frame_claim(const audit::AuditResult& result,
                                             const std::string& label) {
  for (const audit::ClaimResult& each : result.claims)
    if (each.claim.scope == Scope::Frame && each.label == label) return &each;
  return nullptr;
}

}  // namespace plumb::test_support
