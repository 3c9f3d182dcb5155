#include "mesh/stacks/node_errors.h"

#include <algorithm>
#include <utility>

#include "mesh/stacks/selection.h"

namespace plumb::mesh::stacks {
namespace {

// Bounds below this part of a node's voxel are tight enough: most errors are a few times that.
constexpr double kFineVoxels = 1.0 / 8.0;
// Of so many triangles one is among the few that tell most nodes which are too coarse.
constexpr std::size_t kSome = 8;

using Triangles = std::vector<Corners>;

bool is_before(const Corners& a, const Corners& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      if (a[k][axis] != b[k][axis]) return a[k][axis] < b[k][axis];
    }
  }
  return false;
}

// Those that are none of some trees, to the bit.
Triangles without(Triangles triangles, const std::vector<const TriangleTree*>& trees) {
  Triangles others;
  for (const TriangleTree* tree : trees)
    others.insert(others.end(), tree->triangles().begin(), tree->triangles().end());
  std::sort(others.begin(), others.end(), is_before);
  std::erase_if(triangles, [&](const Corners& triangle) {
    return std::binary_search(others.begin(), others.end(), triangle, is_before);
  });
  return triangles;
}

Triangles some_of(const Triangles& triangles) {
  Triangles some;
  for (std::size_t k = 0; k < triangles.size(); k += kSome) some.push_back(triangles[k]);
  return some;
}

Box box_of(const Triangles& triangles) {
  Box box;
  for (const Corners& triangle : triangles) {
    for (const glm::dvec3& corner : triangle) box.add(corner);
  }
  return box;
}

}  // namespace

std::vector<std::vector<Corners>> parted(const std::vector<Corners>& triangles, const Box& box,
                                         int count) {
  std::vector<Triangles> parts(static_cast<std::size_t>(count * count * count));
  for (const Corners& triangle : triangles) {
    const glm::dvec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    int part = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const double along =
          count * (middle[axis] - box.low[axis]) / (box.high[axis] - box.low[axis]);
      part = count * part + static_cast<int>(std::clamp(along, 0.0, count - 1.0));
    }
    parts[static_cast<std::size_t>(part)].push_back(triangle);
  }
  return parts;
}

Box drawn_box(const StackDensities& densities, const Node& node) {
  const terrain::StackField& field = densities.field();
  Box box = densities.box(node);
  const glm::dvec3 reach = 2.0 * static_cast<double>(1 << node.level) *
                           glm::dvec3(field.dx_m, field.dy_m, field.voxel_m);
  box.low -= reach;
  box.high += reach;
  return box;
}

// Triangles in parts against a surface, both made only where something is not known yet.
struct NodeErrors::Question {
  std::map<Key, std::vector<Part>>& answers;
  Key key;
  std::function<std::vector<Triangles>()> parts;
  std::function<std::shared_ptr<const Surface>()> surface;
  double fine_m;
  const Allowed& allowed;
  Depth depth;
};

NodeErrors::NodeErrors(const StackDensities& densities, NodeCache& cache)
    : densities_(densities), finest_(densities, cache) {}

std::shared_ptr<const TriangleTree> NodeErrors::tree(const NodeMesh& mesh) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = trees_.find(&mesh);
    if (found != trees_.end()) return found->second;
  }
  auto made = std::make_shared<const TriangleTree>(triangles_of(mesh, densities_));
  const std::lock_guard lock(mutex_);
  return trees_.try_emplace(&mesh, std::move(made)).first->second;
}

std::shared_ptr<const Surface> NodeErrors::drawn_surface(
    const std::vector<const NodeMesh*>& meshes) {
  std::vector<std::shared_ptr<const TriangleTree>> trees;
  for (const NodeMesh* mesh : meshes) trees.push_back(tree(*mesh));
  return std::make_shared<const TreesTogether>(std::move(trees));
}

std::vector<NodeErrors::Part> NodeErrors::known_parts(const Question& question) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = question.answers.find(question.key);
    if (found != question.answers.end()) return found->second;
  }
  std::vector<Part> parts;
  for (const Triangles& triangles : question.parts()) parts.push_back({box_of(triangles)});
  const std::lock_guard lock(mutex_);
  return question.answers.try_emplace(question.key, std::move(parts)).first->second;
}

// Of those that are wanted, and not known.
template <class Measured>
void NodeErrors::measure(const Question& question, std::vector<Part>& parts,
                         double Part::*distance_m, const std::vector<std::size_t>& wanted,
                         const Measured& measured) {
  std::vector<std::size_t> missing;
  for (const std::size_t k : wanted) {
    if (parts[k].*distance_m < 0.0) missing.push_back(k);
  }
  if (missing.empty()) return;
  const std::vector<Triangles> triangles = question.parts();
  const auto surface = question.surface();
  for (const std::size_t k : missing) parts[k].*distance_m = measured(triangles[k], *surface);
  const std::lock_guard lock(mutex_);
  std::vector<Part>& kept = question.answers.find(question.key)->second;
  for (const std::size_t k : missing) kept[k].*distance_m = parts[k].*distance_m;
}

// What decides is `all_m`; the others save most of the work that it takes.
void NodeErrors::answer(const Question& question, std::vector<Box>& over) {
  std::vector<Part> parts = known_parts(question);
  std::vector<std::size_t> wanted;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (!parts[k].box.empty() && question.allowed.is_wanted(parts[k].box)) wanted.push_back(k);
  }
  const auto keep_over = [&](double Part::*distance_m) {
    std::erase_if(wanted, [&](std::size_t k) {
      return !question.allowed.is_over(parts[k].box, parts[k].*distance_m);
    });
  };
  if (question.depth == Depth::SomePoints) {
    measure(question, parts, &Part::some_m, wanted, [](const Triangles& part, const Surface& to) {
      return distance_of_middles(some_of(part), to);
    });
    keep_over(&Part::some_m);
  } else {
    measure(question, parts, &Part::rough_m, wanted, rough_distance_bound);
    keep_over(&Part::rough_m);
    measure(question, parts, &Part::all_m, wanted,
            [&question](const Triangles& part, const Surface& to) {
              return distance_bound(part, to, question.fine_m);
            });
    keep_over(&Part::all_m);
  }
  for (const std::size_t k : wanted) over.push_back(parts[k].box);
}

double NodeErrors::fine_m(int level) const {
  return kFineVoxels * static_cast<double>(1 << level) * densities_.field().voxel_m;
}

// Where a node of level 0 draws the finest triangles themselves there is nothing to measure.
std::vector<Box> NodeErrors::over_to_finest(const DrawnMesh& drawn, const Allowed& allowed,
                                            Depth depth) {
  std::vector<Box> over;
  if (drawn.mesh->faces.empty()) return over;
  const Node& node = drawn.node;
  const auto parts = [&] {
    Triangles triangles = tree(*drawn.mesh)->triangles();
    if (node.level == 0) triangles = without(std::move(triangles), finest_.within(node));
    return parted(triangles, densities_.box(node), kParts);
  };
  answer({to_finest_, Key{node, node, {drawn.mesh.get()}}, parts,
          [&] { return finest_.around(node); }, fine_m(node.level), allowed, depth},
         over);
  return over;
}

// The finest surface is asked for by finer nodes, so that it is not made where it is not wanted.
std::vector<Box> NodeErrors::over_from_finest(
    const Node& node, std::span<const std::shared_ptr<const NodeMesh>> meshes,
    const Allowed& allowed, Depth depth) {
  std::vector<const NodeMesh*> drawn;
  for (const auto& mesh : meshes) {
    if (!mesh->faces.empty()) drawn.push_back(mesh.get());
  }
  int count = kParts;
  std::vector<Node> finer{node};
  for (; count > 1 && finer.front().level > 0; count /= 2) {
    std::vector<Node> children;
    for (const Node& of : finer) {
      for (int k = 0; k < 8; ++k) children.push_back(of.child(k));
    }
    finer = std::move(children);
  }
  std::vector<Box> over;
  for (const Node& of : finer) {
    if (!allowed.is_wanted(finest_.reach(of))) continue;
    const auto parts = [&] {
      Triangles triangles;
      for (const TriangleTree* tree : finest_.within(of))
        triangles.insert(triangles.end(), tree->triangles().begin(), tree->triangles().end());
      if (node.level == 0 && !meshes.front()->faces.empty()) {
        const auto own = tree(*meshes.front());
        triangles = without(std::move(triangles), {own.get()});
      }
      return parted(triangles, densities_.box(of), count);
    };
    answer({from_finest_, Key{node, of, drawn}, parts, [&] { return drawn_surface(drawn); },
            fine_m(node.level), allowed, depth},
           over);
  }
  return over;
}

double NodeErrors::apart_px(const Camera& camera, const Box& box, double distance_m) const {
  return stacks::apart_px(camera, box, distance_m);
}

bool NodeErrors::is_over_among_equals(const DrawnMesh& drawn,
                                      const std::function<NodeMeshes()>& around,
                                      const Allowed& allowed) {
  const NodeMeshes meshes = around();
  // Most that are over are so at some points already.
  for (const auto depth : {Depth::SomePoints, Depth::AllPoints}) {
    if (!over_from_finest(drawn.node, meshes, allowed, depth).empty() ||
        !over_to_finest(drawn, allowed, depth).empty())
      return true;
  }
  return false;
}

std::vector<Box> NodeErrors::over(const DrawnMesh& drawn, const NodeMeshes& around,
                                  const Allowed& allowed) {
  std::vector<Box> over = over_to_finest(drawn, allowed);
  for (const Box& box : over_from_finest(drawn.node, around, allowed)) over.push_back(box);
  return over;
}

}  // namespace plumb::mesh::stacks
