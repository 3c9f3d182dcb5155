// A box's slices, and what they and its polygons cost.
#pragma once

#include <limits>
#include <optional>

#include "core/camera.h"
#include "slicing/cost_profile.h"
#include "slicing/slice_bundle.h"
#include "slicing/slicing_tree.h"

namespace plumb::slicing {

enum class Variant { Published, Conservative };

/// What a box looks like from the eye, as the cost model wants it.
struct BoxView {
  double distance_m = 0.0;                                   // min l
  double cos_least = 1.0;                                    // cosine of the least angle of sight
  double sin_most = 0.0;                                     // sine of the greatest
  double most_px = std::numeric_limits<double>::infinity();  // that anything covers
};

/// min l over the eight corners and the angles of sight to them, the least one being zero where the
/// eye's height lies within the box's.
///
///   (1) Published: as the article has it. min l is no lower bound: an eye above the middle of a
///   large box is nearer to its top face.
///   (2) Conservative: min l is the distance of the box itself, and nothing covers more pixels than
///   the image has.
/// Source: [Röttger & Ertl 2001], section 4.
BoxView view_of_box(const Box& box, const Camera& camera, Variant variant);

/// x'(length, l, cosine): the pixels that a length spans.
double projected_px(const Camera& camera, double length_m, double distance_m, double cosine);

/// The cost of the node's whole mesh: fans of eight triangles and ten vertices.
double cost_of_polygons_s(const SlicingNode& node, const BoxView& view, const Camera& camera,
                          const CostProfile& profile);

struct PricedBundle {
  SliceBundle bundle;
  double cost_s = 0.0;
};

/// R_n(B), how much the depth below the ground may change along a ray while it goes one metre along
/// `axis`: for all rays from the eye through the box, with triangles no steeper than `steepest`.
/// +inf if a ray may run across the axis there. Derived in docs/algorithms/slicing.md.
double depth_change(const Box& box, double steepest, const glm::dvec3& eye_m, Axis axis);

/// The node's slices for a gap of `tolerance_px` on the screen, > 0.
///
/// Published: horizontal where the line of sight to the box's middle is steeper than 45 degrees,
/// else across the horizontal axis that it runs along most; spaced so that min l and the angle of
/// sight promise the gap; borders of a pixel and raised by half a pixel.
/// Conservative: across the axis that costs least, closed, so many that
///   (1) every point of a ray before its drawn point is less than allowed_displacement_m below the
///   ground, and so is the drawn point, which lies above it by closing_raise_m at most;
/// nothing if no axis can keep that.
/// `camera` is relative to the terrain's origin; the node is not empty. `borders` off leaves the
/// published bundle's borders out, to see what they are for.
std::optional<PricedBundle> price_bundle(const SlicingNode& node, std::uint32_t index,
                                         const Camera& camera, Variant variant, double tolerance_px,
                                         const CostProfile& profile, bool borders = true);

}  // namespace plumb::slicing
