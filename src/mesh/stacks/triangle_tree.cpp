#include "mesh/stacks/triangle_tree.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace plumb::mesh::stacks {
namespace {

constexpr std::uint32_t kLeaf = 3;

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

double part(double of, double whole) { return whole > 0.0 ? of / whole : 0.0; }

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

// By the region that the point lies over: a corner, an edge or the inside. It is the distance to a
// point of the triangle whatever the roundings, one without area included.
double squared_distance(const glm::dvec3& point, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 ab = b - a, ac = c - a, ap = point - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return squared(ap);
  const glm::dvec3 bp = point - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return squared(bp);
  const glm::dvec3 cp = point - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return squared(cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) return squared(ap - d1 / (d1 - d3) * ab);
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) return squared(ap - d2 / (d2 - d6) * ac);
  if (va <= 0.0 && d4 >= d3 && d5 >= d6)
    return squared(bp - part(d4 - d3, (d4 - d3) + (d5 - d6)) * (c - b));
  const double sum = va + vb + vc;
  return squared(ap - part(vb, sum) * ab - part(vc, sum) * ac);
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
