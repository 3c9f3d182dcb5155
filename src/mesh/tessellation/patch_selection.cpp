#include "mesh/tessellation/patch_selection.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchLayout;
using patch_quadtree::PatchNumbers;
using patch_quadtree::PatchPlace;

namespace {

const PatchBounds& bounds_of(const Prepared& prepared, const PatchPlace& patch) {
  return prepared.bounds->patches[static_cast<std::size_t>(prepared.header().layout.index(patch))];
}

// gamma Err / rho. Source: [Yusov & Shevtsov 2011, section 5].
double published_reach_px(const ViewTest& view, const Box& box, double error_m) {
  glm::dvec3 nearest;
  for (int axis = 0; axis < 3; ++axis)
    nearest[axis] = std::clamp(view.camera.eye_m[axis], box.low[axis], box.high[axis]);
  const glm::dvec3 apart = nearest - view.camera.eye_m;
  const double gamma = std::max(view.camera.gamma_h, view.camera.gamma_v);
  return gamma * error_m / std::sqrt(glm::dot(apart, apart));
}

class Selector {
 public:
  Selector(const Prepared& prepared, const ViewTest& view)
      : prepared_(prepared), view_(view), layout_(prepared.header().layout) {
    selection_.state.assign(static_cast<std::size_t>(layout_.patch_count()),
                            PatchSelection::kLeftOut);
  }

  PatchSelection take() {
    std::vector<PatchPlace> level{layout_.root()};
    while (!level.empty()) {  // breadth first: numbers rise
      std::vector<PatchPlace> below;
      for (const PatchPlace& patch : level) visit(patch, below);
      level = std::move(below);
    }
    return std::move(selection_);
  }

 private:
  void visit(const PatchPlace& patch, std::vector<PatchPlace>& below) {
    ++selection_.visited;
    if (bounds_of(prepared_, patch).is_void()) return;
    std::int32_t& state = selection_.state[static_cast<std::size_t>(layout_.index(patch))];
    if (patch.level == 0 || keeps(patch)) {
      state = static_cast<std::int32_t>(selection_.drawn.size());
      selection_.drawn.push_back(patch);
      return;
    }
    state = PatchSelection::kAbove;
    for (int c = 0; c < 4; ++c) {
      const PatchPlace child = patch.child(c & 1, c >> 1);
      if (layout_.contains(child)) below.push_back(child);
    }
  }

  bool keeps(const PatchPlace& patch) {
    ++selection_.tested;
    const Box box = box_of(prepared_, patch);
    const double drawn_m = prepared_.bounds->error_m(layout_.index(patch));
    if (prepared_.parameters.variant == Variant::Conservative)
      return std::isfinite(drawn_m) && drawn_m <= view_.allowed_m(box);
    const double printed_m = double{bounds_of(prepared_, patch).published_m} +
                             prepared_.header().quantiser.error_m(patch.level);
    const auto passes = [&](double error_m, bool bound) {
      if (view_.in_metres()) return error_m <= view_.tolerance.value;
      return bound ? error_m <= view_.allowed_m(box)
                   : published_reach_px(view_, box, error_m) <= view_.tolerance.value;
    };
    const Mends& mends = prepared_.parameters.mends;
    const bool by_distance = mends[static_cast<std::size_t>(Cause::DistanceTest)];
    const bool as_drawn = mends[static_cast<std::size_t>(Cause::BilinearError)];
    const double error_m = as_drawn ? drawn_m : printed_m;
    if (!passes(error_m, by_distance)) return false;
    selection_.finer_by_distance += !by_distance && !passes(error_m, true);
    selection_.finer_by_error +=
        !as_drawn && std::isfinite(drawn_m) && !passes(drawn_m, by_distance);
    return true;
  }

  const Prepared& prepared_;
  const ViewTest& view_;
  const PatchLayout& layout_;
  PatchSelection selection_;
};

}  // namespace

PatchSelection select_patches(const Prepared& prepared, const ViewTest& view) {
  return Selector(prepared, view).take();
}

std::int64_t patches_in_view(const Prepared& prepared, const ViewTest& view,
                             const PatchSelection& selection) {
  return std::ranges::count_if(selection.drawn, [&](const PatchPlace& patch) {
    return may_be_in_view(view.camera, box_of(prepared, patch));
  });
}

Box box_of(const Prepared& prepared, const PatchPlace& patch) {
  const auto& header = prepared.header();
  const PatchBounds& bounds = bounds_of(prepared, patch);
  if (bounds.is_void()) return {};
  const double delta = header.quantiser.error_m(patch.level);
  const int n = header.layout.patch_cells;
  Box box;
  box.add({header.layout.sample_column(patch, 0) * header.dx_m,
           header.layout.sample_row(patch, 0) * header.dy_m, bounds.low_m - delta});
  box.add({header.layout.sample_column(patch, n) * header.dx_m,
           header.layout.sample_row(patch, n) * header.dy_m, bounds.high_m + delta});
  return box;
}

std::vector<Grid<float>> decode_drawn(const Prepared& prepared, const PatchSelection& selection) {
  const PatchLayout& layout = prepared.header().layout;
  const auto state = [&](const PatchPlace& patch) {
    return selection.state[static_cast<std::size_t>(layout.index(patch))];
  };
  std::vector<Grid<float>> heights(selection.drawn.size());
  struct Node {
    PatchPlace place;
    PatchNumbers numbers;
  };
  // Keeps the numbers of those whose children are wanted, and the heights of those that are drawn.
  const auto settle = [&](Node& node) {
    const std::int32_t at = state(node.place);
    if (at < 0) return;
    heights[static_cast<std::size_t>(at)] =
        patch_quadtree::heights_of(node.numbers, prepared.header().quantiser, node.place.level);
    node.numbers = {};
  };
  std::vector<Node> level;
  if (!selection.drawn.empty())
    level.push_back({layout.root(), prepared.decoder->numbers(layout.root())});
  for (Node& root : level) settle(root);
  while (!level.empty()) {
    std::erase_if(level,
                  [&](const Node& node) { return state(node.place) != PatchSelection::kAbove; });
    std::vector<Node> below(4 * level.size());
    parallel_for(static_cast<std::int64_t>(level.size()), 1, [&](std::int64_t k) {
      const Node& node = level[static_cast<std::size_t>(k)];
      patch_quadtree::Family children = prepared.decoder->children(node.place, node.numbers);
      for (int c = 0; c < 4; ++c) {
        auto& child = children[static_cast<std::size_t>(c)];
        if (!child) continue;
        Node& next = below[static_cast<std::size_t>(4 * k + c)];
        next = {node.place.child(c & 1, c >> 1), std::move(*child)};
        settle(next);
      }
    });
    std::erase_if(below, [](const Node& node) { return node.numbers.q.empty(); });
    level = std::move(below);
  }
  return heights;
}

}  // namespace plumb::mesh::tessellation
