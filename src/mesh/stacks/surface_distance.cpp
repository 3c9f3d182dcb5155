#include "mesh/stacks/surface_distance.h"

#include <algorithm>
#include <cmath>

namespace plumb::mesh::stacks {
namespace {

constexpr int kMostCuts = 6;
constexpr double kLoose = 1.1;

class Bound {
 public:
  Bound(std::span<const TriangleTree* const> trees, double fine_m, double at_least)
      : trees_(trees), fine_m_(fine_m), largest_(at_least) {}

  double largest() const { return largest_; }

  void add(const Corners& piece, int cuts) {
    const glm::dvec3 middle = (piece[0] + piece[1] + piece[2]) / 3.0;
    const NearestTriangle nearest = stacks::nearest(middle, trees_);
    if (nearest.triangle == nullptr) {
      largest_ = nearest.squared;
      return;
    }
    double above = 0.0;
    for (const glm::dvec3& corner : piece)
      above = std::max(above, squared_distance(corner, *nearest.triangle));
    above = std::sqrt(above);
    if (above <= largest_) return;
    const double below = std::sqrt(nearest.squared);
    if (above <= std::max(kLoose * below, fine_m_) || cuts == 0) {
      largest_ = above;
      return;
    }
    cut(piece, cuts - 1);
  }

 private:
  void cut(const Corners& piece, int cuts) {
    const glm::dvec3 ab = 0.5 * (piece[0] + piece[1]), bc = 0.5 * (piece[1] + piece[2]),
                     ca = 0.5 * (piece[2] + piece[0]);
    add({ab, bc, ca}, cuts);
    add({piece[0], ab, ca}, cuts);
    add({piece[1], bc, ab}, cuts);
    add({piece[2], ca, bc}, cuts);
  }

  std::span<const TriangleTree* const> trees_;
  double fine_m_, largest_;
};

}  // namespace

NearestTriangle nearest(const glm::dvec3& point, std::span<const TriangleTree* const> trees) {
  NearestTriangle nearest;
  for (const TriangleTree* tree : trees) tree->look_for(point, nearest);
  return nearest;
}

double distance_bound(std::span<const Corners> triangles,
                      std::span<const TriangleTree* const> trees, double fine_m, double at_least) {
  Bound bound(trees, fine_m, at_least);
  for (const Corners& triangle : triangles) bound.add(triangle, kMostCuts);
  return bound.largest();
}

}  // namespace plumb::mesh::stacks
