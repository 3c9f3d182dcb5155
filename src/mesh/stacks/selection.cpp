#include "mesh/stacks/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/screen_error.h"
#include "mesh/stacks/node_errors.h"

namespace plumb::mesh::stacks {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_m(const Camera& camera, const Box& box) {
  return std::sqrt(squared_distance(camera.eye_m, box));
}

double edge_m(const StackDensities& densities, const Node& node) {
  const terrain::StackField& field = densities.field();
  return kNodeVoxels * static_cast<double>(1 << node.level) *
         std::max({field.dx_m, field.dy_m, field.voxel_m});
}

double length(const glm::dvec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

// The tangent of the largest angle between the view's axis and a pixel.
double corner_tangent(const Camera& camera) {
  const double x = std::max(camera.centre_px.x, camera.width_px - camera.centre_px.x),
               y = std::max(camera.centre_px.y, camera.height_px - camera.centre_px.y);
  return length({x / camera.gamma_h, y / camera.gamma_v});
}

// And between that axis and a point of a box: directions within some angle are a convex cone, so a
// corner's is the largest.
double largest_tangent(const Camera& camera, const Box& box) {
  double largest = 0.0;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 view = to_view(camera, box.corner(k));
    if (!(view.z > 0.0)) return kInfinity;
    largest = std::max(largest, length({view.x / view.z, view.y / view.z}));
  }
  return largest;
}

// Whether a node and a child of one beside it share a corner at least.
bool do_touch(const Node& node, const Node& finer) {
  for (int axis = 0; axis < 3; ++axis) {
    const int low = 2 * node.at[axis], at = finer.at[axis];
    if (at < low - 1 || at > low + 2) return false;
  }
  return true;
}

bool do_overlap(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return false;
  }
  return true;
}

// Finds the octree of conservative_selection.
class ConservativeSelection {
 public:
  ConservativeSelection(const StackDensities& densities, Errors& errors, NodeCache& cache,
                        const Camera& camera, double tolerance_px)
      : densities_(densities),
        errors_(errors),
        cache_(cache),
        camera_(camera),
        allowed_{[&camera](const Box& box) { return may_be_in_view(camera, box); },
                 [&camera, &errors, tolerance_px](const Box& box, double distance_m) {
                   return errors.apart_px(camera, box, distance_m) > tolerance_px;
                 }},
        octree_(densities.size()) {}

  Octree octree() {
    divide_as_among_equals();
    do octree_.balance();
    while (refine());
    return std::move(octree_);
  }

 private:
  bool is_seen(const Node& node) const { return may_be_in_view(camera_, errors_.reach(node)); }
  // The nodes in view, by level.
  std::vector<std::vector<Node>> seen_nodes() const {
    std::vector<std::vector<Node>> seen(static_cast<std::size_t>(octree_.root_level()) + 1);
    std::vector<Node> pending{octree_.root()};
    while (!pending.empty()) {
      const Node node = pending.back();
      pending.pop_back();
      if (!octree_.is_inside(node) || !is_seen(node)) continue;
      seen[static_cast<std::size_t>(node.level)].push_back(node);
      for (int k = 0; k < 8 && node.level > 0; ++k) pending.push_back(node.child(k));
    }
    return seen;
  }

  // First every node is taken to be among others of its level. From the finest up: where a node is
  // too coarse those that hold it are not asked.
  void divide_as_among_equals() {
    const auto seen = seen_nodes();
    errors_.make(seen.front());
    std::unordered_set<Node, NodeHash> divided;
    for (const std::vector<Node>& nodes : seen) {
      std::vector<std::uint8_t> over(nodes.size(), 0);
      parallel_for(static_cast<std::int64_t>(nodes.size()), 1, [&](std::int64_t i) {
        const auto k = static_cast<std::size_t>(i);
        if (nodes[k].level == 0) return;
        bool is_divided = false;
        for (int child = 0; child < 8; ++child)
          is_divided = is_divided || divided.contains(nodes[k].child(child));
        over[k] = is_divided || is_over_among_equals(nodes[k]) ? 1 : 0;
      });
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (over[k] != 0) divided.insert(nodes[k]);
      }
    }
    octree_.divide([&](const Node& node) { return divided.contains(node); });
  }

  bool is_over_among_equals(const Node& node) {
    const auto around = [&] {
      NodeMeshes meshes;
      for_each_around(node, [&](const Node& beside) {
        if (octree_.is_inside(beside)) meshes.push_back(cache_.mesh(beside, among_equals()));
      });
      return meshes;
    };
    return errors_.is_over_among_equals({node, cache_.mesh(node, among_equals())}, around,
                                        allowed_);
  }

  // Looks at what is drawn, and divides where that is too coarse; false if it is nowhere.
  bool refine() {
    const std::vector<Node> nodes = octree_.drawn();
    const auto meshes = cache_.meshes(octree_, nodes);
    std::unordered_map<Node, std::size_t, NodeHash> index;
    for (std::size_t k = 0; k < nodes.size(); ++k) index.emplace(nodes[k], k);
    std::vector<std::vector<Box>> over(nodes.size());
    parallel_for(static_cast<std::int64_t>(nodes.size()), 1, [&](std::int64_t i) {
      const auto k = static_cast<std::size_t>(i);
      if (!is_seen(nodes[k]) || is_finest(nodes[k])) return;
      NodeMeshes around;
      for (const Node& node : drawn_around(nodes[k])) around.push_back(meshes[index.at(node)]);
      over[k] = errors_.over({nodes[k], meshes[k]}, around, allowed_);
    });
    const Octree before = octree_;
    bool changed = false;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const Box& box : over[k]) {
        refine(before, nodes[k], box);
        changed = true;
      }
    }
    return changed;
  }

  // Whether a node draws the finest surface itself.
  bool is_finest(const Node& node) const {
    if (node.level > 0) return false;
    const Surroundings around = octree_.surroundings(node);
    return std::find(around.begin(), around.end(), Beside::Coarser) == around.end();
  }

  // What is drawn in a node's place and at its borders, itself first.
  std::vector<Node> drawn_around(const Node& node) const {
    std::vector<Node> drawn;
    for_each_around(node, [&](const Node& beside) {
      if (!octree_.is_inside(beside)) return;
      const Node holder = octree_.exists(beside) ? beside : beside.parent();
      if (octree_.is_divided(holder)) {
        for (int k = 0; k < 8; ++k) {
          if (octree_.is_inside(holder.child(k)) && do_touch(node, holder.child(k)))
            drawn.push_back(holder.child(k));
        }
      } else if (std::find(drawn.begin(), drawn.end(), holder) == drawn.end()) {
        drawn.push_back(holder);
      }
    });
    return drawn;
  }

  // Divides what is coarser near a box in a node, or else the node itself, or else what is coarser
  // anywhere beside it: the finest level has no error but beside that.
  void refine(const Octree& before, const Node& node, const Box& box) {
    const auto is_near = [&](const Node& coarse) {
      return do_overlap(box, drawn_box(densities_, coarse));
    };
    if (divide_coarser(before, node, is_near)) return;
    if (node.level > 0) {
      if (octree_.is_drawn(node)) octree_.divide(node);
    } else {
      divide_coarser(before, node, [](const Node&) { return true; });
    }
  }

  template <class Wanted>
  bool divide_coarser(const Octree& before, const Node& node, const Wanted& is_wanted) {
    bool found = false;
    for_each_around(node, [&](const Node& beside) {
      if (!before.is_inside(beside) || before.exists(beside) || !is_wanted(beside.parent())) return;
      found = true;
      if (octree_.is_drawn(beside.parent())) octree_.divide(beside.parent());
    });
    return found;
  }

  const StackDensities& densities_;
  Errors& errors_;
  NodeCache& cache_;
  const Camera& camera_;
  Allowed allowed_;
  Octree octree_;
};

}  // namespace

double extent_px(const Camera& camera, const Box& box, double edge_m) {
  const double distance = distance_m(camera, box);
  return distance > 0.0 ? edge_m * camera.gamma_h / distance : kInfinity;
}

double apart_px(const Camera& camera, const Box& box, double distance_m) {
  if (!(distance_m > 0.0)) return 0.0;
  const double away = stacks::distance_m(camera, box);
  if (!(distance_m < away)) return kInfinity;
  const double t = distance_m / std::sqrt((away - distance_m) * (away + distance_m)),
               s = std::min(corner_tangent(camera), largest_tangent(camera, box));
  return s * t < 1.0 ? std::max(camera.gamma_h, camera.gamma_v) * t * (1.0 + s * s) / (1.0 - s * t)
                     : kInfinity;
}

Octree published_selection(const StackDensities& densities, const Camera& camera,
                           const Tolerance& tolerance) {
  Octree octree(densities.size());
  octree.divide([&](const Node& node) {
    return extent_px(camera, densities.box(node), edge_m(densities, node)) > tolerance.value;
  });
  octree.balance();
  return octree;
}

Octree conservative_selection(const StackDensities& densities, Errors& errors, NodeCache& cache,
                              const Camera& camera, const Tolerance& tolerance) {
  return ConservativeSelection(densities, errors, cache, camera, tolerance.value).octree();
}

}  // namespace plumb::mesh::stacks
