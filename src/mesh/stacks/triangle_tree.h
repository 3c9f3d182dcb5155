// Triangles of a node, to be asked for the nearest one.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/box.h"

namespace plumb::mesh::stacks {

using Corners = std::array<glm::dvec3, 3>;

/// The squared distance from a point to a triangle, its inside, edges and corners.
double squared_distance(const glm::dvec3& point, const Corners& triangle);

/// And to a box, its inside counted as zero.
double squared_distance(const glm::dvec3& point, const Box& box);

struct NearestTriangle {
  double squared = std::numeric_limits<double>::infinity();
  const Corners* triangle = nullptr;  // null: none nearer than what was asked for
};

/// Triangles that can be asked for the nearest one.
class Surface {
 public:
  virtual ~Surface() = default;
  /// Replaces `nearest` by a triangle that is nearer to the point, if there is one.
  virtual void look_for(const glm::dvec3& point, NearestTriangle& nearest) const = 0;
};

/// A binary tree of boxes over triangles.
class TriangleTree final : public Surface {
 public:
  TriangleTree() = default;
  explicit TriangleTree(std::vector<Corners> triangles);

  const std::vector<Corners>& triangles() const { return triangles_; }
  void look_for(const glm::dvec3& point, NearestTriangle& nearest) const override;

 private:
  struct Branch {
    Box box;
    std::uint32_t first = 0, count = 0;  // triangles of a leaf; count 0: two branches follow
    std::uint32_t second = 0;            // the second of them; the first is the next one
  };

  void build(std::uint32_t first, std::uint32_t last);

  std::vector<Corners> triangles_;
  std::vector<Branch> branches_;
};

}  // namespace plumb::mesh::stacks
