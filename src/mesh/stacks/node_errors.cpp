#include "mesh/stacks/node_errors.h"

#include <algorithm>
#include <utility>

namespace plumb::mesh::stacks {
namespace {

// Parts along a node's side.
constexpr int kParts = 4;
// Bounds below this part of a node's voxel are tight enough: most errors are a few times that.
constexpr double kFineVoxels = 1.0 / 8.0;
// Of so many triangles one is among the few that tell most nodes which are too coarse.
constexpr std::size_t kSome = 8;

using Triangles = std::vector<Corners>;

// By the part of a box, `count` along each side, that a triangle's middle lies in or is nearest to.
std::vector<Triangles> parted(std::span<const TriangleTree* const> trees, const Box& box,
                              int count) {
  std::vector<Triangles> parts(static_cast<std::size_t>(count * count * count));
  for (const TriangleTree* tree : trees) {
    for (const Corners& triangle : tree->triangles()) {
      const glm::dvec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
      int part = 0;
      for (int axis = 2; axis >= 0; --axis) {
        const double along =
            count * (middle[axis] - box.low[axis]) / (box.high[axis] - box.low[axis]);
        part = count * part + static_cast<int>(std::clamp(along, 0.0, count - 1.0));
      }
      parts[static_cast<std::size_t>(part)].push_back(triangle);
    }
  }
  return parts;
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

// Triangles in parts against a surface, both made only where something is not known yet.
struct NodeErrors::Question {
  std::map<Key, std::vector<Part>>& answers;
  Key key;
  std::function<std::vector<Triangles>()> parts;
  std::function<std::shared_ptr<const Surface>()> surface;
  double fine_m;
  const IsWanted& is_wanted;
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

void NodeErrors::answer(const Question& question, std::vector<PartError>& errors) {
  const bool is_all = question.depth == Depth::AllPoints;
  double Part::*const error_m = is_all ? &Part::all_m : &Part::some_m;
  std::vector<Part> parts = known_parts(question);
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts[k].box.empty() || !question.is_wanted(parts[k].box)) continue;
    if (parts[k].*error_m < 0.0) missing.push_back(k);
  }
  if (!missing.empty()) {
    const std::vector<Triangles> triangles = question.parts();
    const auto surface = question.surface();
    for (const std::size_t k : missing) {
      parts[k].*error_m = is_all ? distance_bound(triangles[k], *surface, question.fine_m)
                                 : distance_of_middles(some_of(triangles[k]), *surface);
    }
    const std::lock_guard lock(mutex_);
    std::vector<Part>& kept = question.answers.find(question.key)->second;
    for (const std::size_t k : missing) kept[k].*error_m = parts[k].*error_m;
  }
  for (const Part& part : parts) {
    if (part.*error_m > 0.0 && question.is_wanted(part.box))
      errors.push_back({part.box, part.*error_m});
  }
}

std::vector<PartError> NodeErrors::to_finest(const DrawnMesh& drawn, const IsWanted& is_wanted,
                                             Depth depth) {
  std::vector<PartError> errors;
  if (drawn.mesh->faces.empty()) return errors;
  const double fine_m =
      kFineVoxels * static_cast<double>(1 << drawn.node.level) * densities_.field().voxel_m;
  const auto parts = [&] {
    const auto tree = this->tree(*drawn.mesh);
    const TriangleTree* pointer = tree.get();
    return parted({&pointer, 1}, densities_.box(drawn.node), kParts);
  };
  answer({to_finest_, Key{drawn.node, drawn.node, {drawn.mesh.get()}}, parts,
          [&] { return finest_.around(drawn.node); }, fine_m, is_wanted, depth},
         errors);
  return errors;
}

// The finest surface is asked for by finer nodes, so that it is not made where it is not wanted.
std::vector<PartError> NodeErrors::from_finest(
    const Node& node, std::span<const std::shared_ptr<const NodeMesh>> meshes,
    const IsWanted& is_wanted, Depth depth) {
  std::vector<PartError> errors;
  std::vector<const NodeMesh*> drawn;
  for (const auto& mesh : meshes) {
    if (!mesh->faces.empty()) drawn.push_back(mesh.get());
  }
  const double fine_m =
      kFineVoxels * static_cast<double>(1 << node.level) * densities_.field().voxel_m;
  int count = kParts;
  std::vector<Node> finer{node};
  for (; count > 1 && finer.front().level > 0; count /= 2) {
    std::vector<Node> children;
    for (const Node& of : finer) {
      for (int k = 0; k < 8; ++k) children.push_back(of.child(k));
    }
    finer = std::move(children);
  }
  for (const Node& of : finer) {
    if (!is_wanted(finest_.reach(of))) continue;
    answer({from_finest_, Key{node, of, drawn},
            [&] { return parted(finest_.within(of), densities_.box(of), count); },
            [&] { return drawn_surface(drawn); }, fine_m, is_wanted, depth},
           errors);
  }
  return errors;
}

}  // namespace plumb::mesh::stacks
