#include "mesh/stacks/triangle_tree.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace plumb::mesh::stacks {
namespace {

constexpr std::uint32_t kLeaf = 8;

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

double squared_distance_to_edge(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length = squared(along);
  const double t = length > 0.0 ? std::clamp(glm::dot(point - a, along) / length, 0.0, 1.0) : 0.0;
  return squared(point - (a + t * along));
}

Box box_of(const Corners& triangle) {
  Box box;
  for (const glm::dvec3& corner : triangle) box.add(corner);
  return box;
}

}  // namespace

double squared_distance(const glm::dvec3& point, const Box& box) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double away = std::max({box.low[axis] - point[axis], point[axis] - box.high[axis], 0.0});
    sum += away * away;
  }
  return sum;
}

double squared_distance(const glm::dvec3& point, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area = squared(normal);
  const bool is_over = area > 0.0 && glm::dot(glm::cross(b - a, point - a), normal) >= 0.0 &&
                       glm::dot(glm::cross(c - b, point - b), normal) >= 0.0 &&
                       glm::dot(glm::cross(a - c, point - c), normal) >= 0.0;
  if (is_over) {
    const double height = glm::dot(point - a, normal);
    return height * height / area;
  }
  return std::min({squared_distance_to_edge(point, a, b), squared_distance_to_edge(point, b, c),
                   squared_distance_to_edge(point, c, a)});
}

TriangleTree::TriangleTree(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

// Halves along the longest side of the box, by the corners' sums; equal ones keep some order that
// the triangles alone decide, and it changes no distance.
void TriangleTree::build(std::uint32_t first, std::uint32_t last) {
  Branch branch;
  for (std::uint32_t k = first; k < last; ++k) branch.box.add(box_of(triangles_[k]));
  const std::size_t at = branches_.size();
  branches_.push_back(branch);
  if (last - first <= kLeaf) {
    branches_[at].first = first;
    branches_[at].count = last - first;
    return;
  }
  const glm::dvec3 extent = branch.box.high - branch.box.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(triangles_.begin() + first, triangles_.begin() + middle,
                   triangles_.begin() + last, [axis](const Corners& p, const Corners& q) {
                     return p[0][axis] + p[1][axis] + p[2][axis] <
                            q[0][axis] + q[1][axis] + q[2][axis];
                   });
  build(first, middle);
  branches_[at].second = static_cast<std::uint32_t>(branches_.size());
  build(middle, last);
}

void TriangleTree::look_for(const glm::dvec3& point, NearestTriangle& nearest) const {
  if (branches_.empty()) return;
  std::array<std::uint32_t, 64> pending{};  // a tree of 2^32 triangles is 30 deep
  std::size_t count = 0;
  pending[count++] = 0;
  while (count > 0) {
    const std::uint32_t at = pending[--count];
    const Branch& branch = branches_[at];
    if (!(squared_distance(point, branch.box) < nearest.squared)) continue;
    for (std::uint32_t k = branch.first; k < branch.first + branch.count; ++k) {
      const double squared = stacks::squared_distance(point, triangles_[k]);
      if (squared < nearest.squared) nearest = {squared, &triangles_[k]};
    }
    if (branch.count > 0) continue;
    const std::uint32_t one = at + 1, other = branch.second;
    const bool one_first = squared_distance(point, branches_[one].box) <=
                           squared_distance(point, branches_[other].box);
    pending[count++] = one_first ? other : one;
    pending[count++] = one_first ? one : other;
  }
}

}  // namespace plumb::mesh::stacks
