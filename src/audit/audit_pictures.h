// The pictures of a report.
#pragma once

#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/truth_terms.h"
#include "image/colour_image.h"
#include "report/heat_map.h"

namespace plumb::audit {

/// The truth and the drawn picture in the same light, with the same height colours, or those of
/// their materials.
image::Rgb8Image truth_picture(const AuditResult& result, const TruthTerms& truth,
                               const Camera& camera);
image::Rgb8Image drawn_picture(const AuditResult& result, const TruthTerms& truth,
                               const DrawnSurface& surface, const Camera& camera);

/// |a - b| of each channel, four times as strong, on black.
image::Rgb8Image difference_picture(const image::Rgb8Image& a, const image::Rgb8Image& b);

/// What the truth demands in greys (terrain dark, sky light, either between them); holes red,
/// overshoots magenta, see-through cracks orange, each defect three pixels wide.
image::Rgb8Image coverage_picture(const AuditResult& result);

/// The triangles as drawn: coloured by level where they have levels, each outlined in dark.
image::Rgb8Image triangles_picture(const AuditResult& result, const DrawnSurface& surface);

/// Which kind of patch each pixel shows, patches outlined, and what the colours mean; for surfaces
/// that have kinds.
image::Rgb8Image kinds_picture(const AuditResult& result, const DrawnSurface& surface);
std::string kinds_legend(const DrawnSurface& surface);

/// A report's picture as one that can be written.
image::Rgb8Image rgb8_of(report::RgbImage picture);
/// Pixels outside the picture are left out.
void paint(image::Rgb8Image& picture, int x, int y, report::Rgb colour);

/// Pictures of one height next to each other, a few white pixels apart.
image::Rgb8Image side_by_side(const std::vector<image::Rgb8Image>& pictures);

/// A map of errors in pixels (or of what has another unit) whose scale ends at `limit_px` (if
/// positive) or at the largest.
struct ErrorMap {
  image::Rgb8Image picture, legend, both;
};
ErrorMap error_map(const AuditResult& result, const std::vector<float>& errors_px,
                   const std::string& title, double limit_px, const std::string& unit = "px");

}  // namespace plumb::audit
