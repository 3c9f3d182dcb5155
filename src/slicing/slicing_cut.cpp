#include "slicing/slicing_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/check.h"
#include "core/screen_error.h"

namespace plumb::slicing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// True if the whole box lies beyond the near plane and between the frustum's sides.
bool is_inside_view(const Camera& camera, const Box& box) {
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 p = to_view(camera, box.corner(k));
    if (!(p.z > camera.near_m)) return false;
    const glm::dvec2 pixel = view_to_pixel(camera, p);
    if (!(pixel.x >= 0.0 && pixel.x <= camera.width_px && pixel.y >= 0.0 &&
          pixel.y <= camera.height_px)) {
      return false;
    }
  }
  return true;
}

enum class Choice { Greedy, Optimal };

class Descent {
 public:
  Descent(const SlicingTree& tree, const Camera& camera, const CutOptions& options, Choice choice)
      : tree_(tree), camera_(camera), options_(options), choice_(choice) {
    cut_.use.assign(tree.count(), NodeUse::Nothing);
  }

  SlicingCut run() {
    if (choice_ == Choice::Optimal) {
      least_s_.assign(tree_.count(), 0.0);
      find_least(0);
    }
    ++cut_.nodes_visited;
    if (!is_nothing(0)) visit(0, stop_at(0));
    return std::move(cut_);
  }

 private:
  // What a node would be if the descent stopped at it.
  struct Stop {
    std::optional<PricedBundle> slices;
    double polygons_s = 0.0;

    bool as_polygons(bool hybrid) const {
      return !slices || (hybrid && polygons_s < slices->cost_s);
    }
    // The descent compares bundles; polygons count where there are none.
    double own_cost_s() const { return slices ? slices->cost_s : polygons_s; }
    double cost_s(bool hybrid) const { return as_polygons(hybrid) ? polygons_s : slices->cost_s; }
  };

  Stop stop_at(std::uint32_t index) const {
    const SlicingNode& node = tree_.node(index);
    Stop stop;
    if (is_inside_view(camera_, node.box)) {
      stop.slices = price_bundle(node, index, camera_, options_.variant, options_.tolerance_px,
                                 options_.profile, options_.borders);
    }
    BoxView view = view_of_box(node.box, camera_, options_.variant);
    view.distance_m = std::max(view.distance_m, camera_.near_m);  // nothing is seen nearer
    stop.polygons_s = cost_of_polygons_s(node, view, camera_, options_.profile);
    return stop;
  }

  bool is_nothing(std::uint32_t index) const {
    const SlicingNode& node = tree_.node(index);
    return node.empty() || !may_be_in_view(camera_, node.box);
  }

  using StopsBelow = std::array<std::optional<Stop>, 4>;  // nothing where nothing may be seen

  StopsBelow stops_below(std::uint32_t index) const {
    const std::array<std::uint32_t, 4> children = tree_.children(index);
    StopsBelow stops;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!is_nothing(children[k])) stops[k] = stop_at(children[k]);
    }
    return stops;
  }

  // Returns the branch of the slices below; kNoPrimitive if there are none.
  std::uint32_t visit(std::uint32_t index, const Stop& stop) {
    if (!tree_.is_leaf(index)) {
      const StopsBelow below = stops_below(index);
      if (descends(index, stop, below)) return descend(index, below);
    }
    if (stop.as_polygons(options_.hybrid)) {
      cut_.use[index] = NodeUse::Polygons;
      cut_.polygons.push_back(index);
      cut_.cost_s += stop.polygons_s;
      return kNoPrimitive;
    }
    return use_bundle(index, *stop.slices);
  }

  std::uint32_t descend(std::uint32_t index, const StopsBelow& below) {
    cut_.use[index] = NodeUse::Inner;
    const std::array<std::uint32_t, 4> children = tree_.children(index);
    SliceBranch branch;
    for (const std::size_t k : front_to_back(index)) {
      ++cut_.nodes_visited;
      if (!below[k]) continue;
      branch.below[k] = visit(children[k], *below[k]);
      if (branch.below[k] != kNoPrimitive) branch.reach.add(cut_.branches[branch.below[k]].reach);
    }
    if (branch.reach.empty()) return kNoPrimitive;
    cut_.branches.push_back(branch);
    return static_cast<std::uint32_t>(cut_.branches.size()) - 1;
  }

  bool descends(std::uint32_t index, const Stop& stop, const StopsBelow& below) const {
    if (!stop.slices) return true;
    const std::array<std::uint32_t, 4> children = tree_.children(index);
    double children_s = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!below[k]) continue;
      children_s += choice_ == Choice::Optimal ? least_s_[children[k]] : below[k]->own_cost_s();
    }
    return choice_ == Choice::Optimal ? stop.cost_s(options_.hybrid) > children_s
                                      : stop.slices->cost_s > options_.descend_factor * children_s;
  }

  // The least cost of everything below a node, of it and of all its descendants.
  void find_least(std::uint32_t index) {
    if (is_nothing(index)) return;
    const Stop stop = stop_at(index);
    const double own_s =
        stop.slices || tree_.is_leaf(index) ? stop.cost_s(options_.hybrid) : kInfinity;
    least_s_[index] = own_s;
    if (tree_.is_leaf(index)) return;
    double children_s = 0.0;
    for (const std::uint32_t child : tree_.children(index)) {
      find_least(child);
      children_s += least_s_[child];
    }
    least_s_[index] = std::min(own_s, children_s);
  }

  // The children's places, by the side of the middle on which the eye is: along x first, then along
  // y.
  std::array<std::size_t, 4> front_to_back(std::uint32_t index) const {
    const SlicingNode& south_west = tree_.node(tree_.children(index)[0]);
    const terrain::Heightfield& field = tree_.field();
    const std::size_t east = camera_.eye_m.x > south_west.i1 * field.dx_m ? 1 : 0;
    const std::size_t north = camera_.eye_m.y > south_west.j1 * field.dy_m ? 2 : 0;
    return {0 ^ east ^ north, 1 ^ east ^ north, 2 ^ east ^ north, 3 ^ east ^ north};
  }

  std::uint32_t use_bundle(std::uint32_t index, const PricedBundle& priced) {
    cut_.use[index] = NodeUse::Bundle;
    SliceBranch branch;
    branch.reach = priced.bundle.reach;
    branch.bundle = static_cast<std::uint32_t>(cut_.bundles.size());
    cut_.branches.push_back(branch);
    cut_.bundles.push_back(priced.bundle);
    cut_.slices += priced.bundle.count + (priced.bundle.closed ? 5 : 0);
    cut_.cost_s += priced.cost_s;
    return static_cast<std::uint32_t>(cut_.branches.size()) - 1;
  }

  const SlicingTree& tree_;
  const Camera& camera_;
  const CutOptions& options_;
  Choice choice_;
  std::vector<double> least_s_;  // a node each, where the optimum is wanted
  SlicingCut cut_;
};

void require_usable(const CutOptions& options) {
  require(options.tolerance_px > 0.0 && std::isfinite(options.tolerance_px),
          "tolerance_px must be > 0, got {}", options.tolerance_px);
  require(options.descend_factor > 0.0, "descend_factor must be > 0, got {}",
          options.descend_factor);
  require(options.profile.vertices_per_s > 0.0 && options.profile.pixels_per_s > 0.0,
          "a cost profile's speeds must be > 0, got {} vertices/s and {} pixels/s",
          options.profile.vertices_per_s, options.profile.pixels_per_s);
}

}  // namespace

SlicingCut cut_tree(const SlicingTree& tree, const Camera& camera, const CutOptions& options) {
  require_usable(options);
  return Descent(tree, camera, options, Choice::Greedy).run();
}

SlicingCut optimal_cut(const SlicingTree& tree, const Camera& camera, const CutOptions& options) {
  require_usable(options);
  return Descent(tree, camera, options, Choice::Optimal).run();
}

}  // namespace plumb::slicing
