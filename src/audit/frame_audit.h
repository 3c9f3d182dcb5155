// The audit of one frame of a method, whatever kind of truth it is held against.
#pragma once

#include <string>

#include "audit/audit.h"
#include "audit/coverage.h"
#include "audit/method.h"
#include "audit/truth_terms.h"
#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// How far silhouettes may move where a method is asked for this tolerance: by that much, or not at
/// all where the variant's tolerance is a size and no error.
Band band_of(const Method& method, const std::string& variant, const Tolerance& tolerance);

/// What `camera` sees of the full-detail surface.
HitImage cast_truth(const TruthTerms& truth, const Camera& camera);

/// Draws the surface and judges it.
///
/// true_hits  cast_truth(truth, camera)
/// returns    as audit_picture() of audit.h or solid_audit.h, with the fragments and the time of
///            drawing filled in
AuditResult audit_frame(const TruthTerms& truth, HitImage true_hits, const DrawnSurface& surface,
                        const Camera& camera, const AuditOptions& options);

/// The same with the truth cast, and the time of that filled in.
AuditResult audit_frame(const TruthTerms& truth, const DrawnSurface& surface, const Camera& camera,
                        const AuditOptions& options);

}  // namespace plumb::audit
