#include "terrain/stacks/column_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/check.h"
#include "core/memory.h"

namespace plumb::terrain {
namespace {

__extension__ using Int128 = __int128;

// A place of the lattice: at most 2^60 each way, so that products of differences have 122 bits.
struct Place {
  std::int64_t x = 0, y = 0;
};

struct EdgeUse {
  std::uint32_t low, high, triangle;
  int direction;  // 1 from low to high
};

// Twice the area of a, b, c: above zero if counter-clockwise.
Int128 area_of(const Place& a, const Place& b, const Place& c) {
  return Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
}

int sign_of(Int128 number) { return number > 0 ? 1 : number < 0 ? -1 : 0; }

// On which side of a to b a line lies that is moved east, and far less north: where it is on the
// edge the area's derivative by x decides, then that by y. Zero for an edge of no length alone.
int side_of(const Place& a, const Place& b, Int128 area) {
  if (area != 0) return sign_of(area);
  if (a.y != b.y) return a.y > b.y ? 1 : -1;
  return b.x > a.x ? 1 : b.x < a.x ? -1 : 0;
}

class Lattice {
 public:
  Lattice(const TriangleMesh& mesh, const LineGrid& lines) {
    double largest = 0.0;
    for (const glm::dvec3& v : mesh.vertices_m)
      largest = std::max({largest, std::abs(v.x), std::abs(v.y)});
    for (const auto* axis : {&lines.x_m, &lines.y_m}) {
      for (const double line : *axis) largest = std::max(largest, std::abs(line));
    }
    int exponent = 0;
    std::frexp(largest, &exponent);  // largest < 2^exponent
    shift_ = 60 - exponent;
    for (const glm::dvec3& v : mesh.vertices_m) vertices_.push_back({on(v.x), on(v.y)});
    for (const double x : lines.x_m) x_.push_back(on(x));
    for (const double y : lines.y_m) y_.push_back(on(y));
  }

  /// visit(line, weights of the corners, their sum, sign) for each line that passes the triangle.
  template <class Visit>
  void visit(const Triangle& triangle, const Visit& visit) const {
    const Place &a = vertices_[triangle[0]], &b = vertices_[triangle[1]],
                &c = vertices_[triangle[2]];
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const auto i0 = std::lower_bound(x_.begin(), x_.end(), low_x) - x_.begin(),
               i1 = std::upper_bound(x_.begin(), x_.end(), high_x) - x_.begin(),
               j0 = std::lower_bound(y_.begin(), y_.end(), low_y) - y_.begin(),
               j1 = std::upper_bound(y_.begin(), y_.end(), high_y) - y_.begin();
    for (auto j = j0; j < j1; ++j) {
      for (auto i = i0; i < i1; ++i) {
        const Place line{x_[static_cast<std::size_t>(i)], y_[static_cast<std::size_t>(j)]};
        const std::array<Int128, 3> weights{area_of(b, c, line), area_of(c, a, line),
                                            area_of(a, b, line)};
        const int sign = side_of(b, c, weights[0]);
        if (sign == 0 || side_of(c, a, weights[1]) != sign || side_of(a, b, weights[2]) != sign)
          continue;
        visit(static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * x_.size(), weights, sign);
      }
    }
  }

 private:
  std::int64_t on(double value) const {
    return static_cast<std::int64_t>(std::llrint(std::ldexp(value, shift_)));
  }

  int shift_ = 0;
  std::vector<Place> vertices_;
  std::vector<std::int64_t> x_, y_;
};

// The plane's height; never beyond the corners'. Each weight is exact but for its last rounding, so
// that the height is off by a few units in the last place of the corners' differences.
double height_at(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                 const std::array<Int128, 3>& weights) {
  const auto [low, high] = std::minmax({a.z, b.z, c.z});
  const auto sum = static_cast<double>(weights[0] + weights[1] + weights[2]);
  const double z_m = a.z + (static_cast<double>(weights[1]) / sum) * (b.z - a.z) +
                     (static_cast<double>(weights[2]) / sum) * (c.z - a.z);
  return std::clamp(z_m, low, high);
}

}  // namespace

EdgeCounts count_edges(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      if (a != b)
        uses.push_back(
            {std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(t), a < b ? 1 : -1});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  EdgeCounts counts;
  std::uint32_t first_triangle = kNoPrimitive;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    int sum = 0;
    for (; end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high;
         ++end)
      sum += uses[end].direction;
    counts.non_manifold += end - begin > 2 ? 1 : 0;
    if (end - begin == 1) {
      ++counts.boundary;
      if (uses[begin].triangle < first_triangle) {
        first_triangle = uses[begin].triangle;
        counts.first_boundary_m =
            0.5 * (mesh.vertices_m[uses[begin].low] + mesh.vertices_m[uses[begin].high]);
      }
    } else if (sum != 0) {
      ++counts.unbalanced;
    }
  }
  return counts;
}

Crossings cross(const TriangleMesh& mesh, const LineGrid& lines) {
  const Lattice lattice(mesh, lines);
  Crossings crossings;
  crossings.first.assign(lines.size() + 1, 0);
  std::uint64_t count = 0;
  for (const Triangle& triangle : mesh.triangles) {
    lattice.visit(triangle, [&](std::size_t line, const auto&, int) {
      ++crossings.first[line];
      ++count;
    });
  }
  if (count > std::numeric_limits<std::uint32_t>::max())
    input_error("{} crossings of a mesh are more than 2^32 - 1: the stacks stand too close", count);
  require_memory(static_cast<std::int64_t>(count * sizeof(Crossing)), "the crossings of the mesh");
  crossings.of.resize(count);
  std::uint32_t sum = 0;  // each line's end, from which it is filled to its beginning
  for (std::uint32_t& first : crossings.first) first = sum += first;
  for (const Triangle& t : mesh.triangles) {
    lattice.visit(t, [&](std::size_t line, const std::array<Int128, 3>& weights, int sign) {
      crossings.of[--crossings.first[line]] = {
          height_at(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]], weights),
          sign};
    });
  }
  for (std::size_t line = 0; line < lines.size(); ++line) {
    std::sort(crossings.of.begin() + crossings.first[line],
              crossings.of.begin() + crossings.first[line + 1],
              [](const Crossing& a, const Crossing& b) {
                return std::tie(a.z_m, a.sign) < std::tie(b.z_m, b.sign);
              });
  }
  return crossings;
}

}  // namespace plumb::terrain
