#include "mesh/stacks/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace plumb::mesh::stacks {
namespace {

constexpr int kMostCuts = 6;
constexpr double kLoose = 1.1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Knowing something that is not far.
NearestTriangle nearest_to_middle(const Corners& corners, const Surface& surface,
                                  const Corners* near) {
  const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  NearestTriangle nearest;
  if (near != nullptr) nearest = {squared_distance(middle, *near), near};
  surface.look_for(middle, nearest);
  return nearest;
}

// A piece of a triangle, and the triangle of the surface that is nearest to its middle.
struct Piece {
  Corners corners;
  const Corners* nearest = nullptr;
  double above_squared = 0.0;  // no point of the piece is farther
  int cuts = 0;

  friend bool operator<(const Piece& a, const Piece& b) {
    return a.above_squared < b.above_squared;
  }
};

// The piece that may be farthest is cut, until none may be much farther than some point is.
class Bound {
 public:
  Bound(const Surface& surface, double fine_m) : surface_(surface), fine_m_(fine_m) {}

  double of(std::span<const Corners> triangles) {
    const Corners* last = nullptr;
    for (const Corners& triangle : triangles) {
      last = add(triangle, last, kInfinity, 0);
      if (last == nullptr) return kInfinity;
    }
    double largest = 0.0;
    while (!pieces_.empty()) {
      std::pop_heap(pieces_.begin(), pieces_.end());
      const Piece piece = pieces_.back();
      pieces_.pop_back();
      const double above = std::sqrt(piece.above_squared);
      if (above <= std::max({kLoose * std::sqrt(below_squared_), fine_m_, largest}))
        return std::max(above, largest);
      if (piece.cuts < kMostCuts) {
        cut(piece);
      } else {
        largest = std::max(largest, above);
      }
    }
    return largest;
  }

 private:
  // `known`: no point of it is farther, squared.
  const Corners* add(const Corners& corners, const Corners* near, double known, int cuts) {
    const NearestTriangle nearest = nearest_to_middle(corners, surface_, near);
    if (nearest.triangle == nullptr) return nullptr;
    below_squared_ = std::max(below_squared_, nearest.squared);
    push(corners, nearest.triangle, known, cuts);
    return nearest.triangle;
  }

  void push(const Corners& corners, const Corners* nearest, double known, int cuts) {
    Piece piece{corners, nearest, 0.0, cuts};
    for (const glm::dvec3& corner : corners)
      piece.above_squared = std::max(piece.above_squared, squared_distance(corner, *nearest));
    piece.above_squared = std::min(piece.above_squared, known);
    pieces_.push_back(piece);
    std::push_heap(pieces_.begin(), pieces_.end());
  }

  // The middle one's middle is the whole one's.
  void cut(const Piece& piece) {
    const auto& [a, b, c] = piece.corners;
    const glm::dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    push({ab, bc, ca}, piece.nearest, piece.above_squared, piece.cuts + 1);
    for (const Corners& corners : {Corners{a, ab, ca}, Corners{b, bc, ab}, Corners{c, ca, bc}})
      add(corners, piece.nearest, piece.above_squared, piece.cuts + 1);
  }

  const Surface& surface_;
  double fine_m_, below_squared_ = 0.0;
  std::vector<Piece> pieces_;
};

}  // namespace

void TreesTogether::look_for(const glm::dvec3& point, NearestTriangle& nearest) const {
  for (const auto& tree : trees_) tree->look_for(point, nearest);
}

double distance_bound(std::span<const Corners> triangles, const Surface& surface, double fine_m) {
  return Bound(surface, fine_m).of(triangles);
}

double rough_distance_bound(std::span<const Corners> triangles, const Surface& surface) {
  return Bound(surface, kInfinity).of(triangles);
}

double distance_of_middles(std::span<const Corners> triangles, const Surface& surface) {
  NearestTriangle nearest;
  double largest_squared = 0.0;
  for (const Corners& triangle : triangles) {
    nearest = nearest_to_middle(triangle, surface, nearest.triangle);
    largest_squared = std::max(largest_squared, nearest.squared);
  }
  return std::sqrt(largest_squared);
}

}  // namespace plumb::mesh::stacks
