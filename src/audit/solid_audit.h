// The audit of a drawn surface whose truth is no heightfield.
#pragma once

#include "audit/audit.h"
#include "audit/mesh_truth.h"

namespace plumb::audit {

/// Judges a surface and the picture that was drawn of it, as audit_picture of a heightfield does:
/// depths, normals (outside told from inside), distances to nearest points both ways, coverage
/// (solid_coverage.h), topology (solid_topology.h) and every claim that speaks of these.
///
/// truth    its caster's cast_frame(camera) is `true_hits`
/// returns  of_heights is false. Claims of samples, surfaces and vertical pixel errors are errors
///
///   (1) The result has the same bits on every machine and number of threads, `times` apart.
/// Throws std::invalid_argument if pictures and surface do not belong together or the surface is no
/// mesh, InputError for a claim or a limit that is not measured here.
AuditResult audit_picture(const MeshTruth& truth, HitImage true_hits, const DrawnSurface& surface,
                          HitImage drawn, const Camera& camera, const AuditOptions& options = {});

/// Casts the truth, draws the surface and judges it.
AuditResult audit_surface(const MeshTruth& truth, const DrawnSurface& surface, const Camera& camera,
                          const AuditOptions& options = {});

}  // namespace plumb::audit
