#include "audit/mesh_shift.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::audit {
namespace {

class Search {
 public:
  Search(const HeightfieldTruth& truth, const std::vector<glm::dvec3>& points)
      : truth_(truth),
        points_(points),
        step_m_(0.5 * std::min(truth.field().dx_m, truth.field().dy_m)),
        least_over_(0.9 * static_cast<double>(over(glm::dvec3(0.0)))),
        best_{glm::dvec3(0.0), off(glm::dvec3(0.0))} {}

  MeshShift run() {
    constexpr int kRounds = 20;
    for (int round = 0; round < kRounds && best_.off_m > truth_.slack_m; ++round) {
      glm::dvec3 step = newton_step();
      bool better = false;
      for (int half = 0; half < 6 && !better; ++half, step *= 0.5) {
        const double here = off(best_.by_m + step);
        better = here < best_.off_m;
        if (better) best_ = {best_.by_m + step, here};
      }
      if (!better) break;
    }
    return best_;
  }

 private:
  double height(const glm::dvec3& p, double dx, double dy) const {
    return truth_.height_at(p.x + dx, p.y + dy);
  }
  std::size_t over(const glm::dvec3& by) const {
    return static_cast<std::size_t>(
        std::count_if(points_.begin(), points_.end(),
                      [&](const glm::dvec3& p) { return !std::isnan(height(p, by.x, by.y)); }));
  }
  double off(const glm::dvec3& by) const {
    double sum = 0.0;
    std::size_t count = 0;
    for (const glm::dvec3& p : points_) {
      const double h = height(p, by.x, by.y);
      if (std::isnan(h)) continue;
      sum += std::abs(p.z + by.z - h);
      ++count;
    }
    if (count == 0 || static_cast<double>(count) < least_over_)
      return std::numeric_limits<double>::infinity();
    return sum / static_cast<double>(count);
  }

  glm::dvec3 newton_step() const {
    glm::dmat3 normal(0.0);
    glm::dvec3 right(0.0);
    for (const glm::dvec3& point : points_) {
      const glm::dvec3 p = point + best_.by_m;
      const double h = height(p, 0.0, 0.0);
      const double dx = (height(p, step_m_, 0.0) - height(p, -step_m_, 0.0)) / (2.0 * step_m_),
                   dy = (height(p, 0.0, step_m_) - height(p, 0.0, -step_m_)) / (2.0 * step_m_);
      const double left = p.z - h;
      if (std::isnan(left + dx + dy)) continue;
      const glm::dvec3 slope(-dx, -dy, 1.0);
      const double weight = 1.0 / (std::abs(left) + 1e-3);
      normal +=
          glm::dmat3(weight * slope.x * slope, weight * slope.y * slope, weight * slope.z * slope);
      right -= weight * left * slope;
    }
    const double size = normal[0][0] + normal[1][1] + normal[2][2];
    for (int k = 0; k < 3; ++k) normal[k][k] += 1e-9 * size + 1e-300;
    return glm::inverse(normal) * right;
  }

  const HeightfieldTruth& truth_;
  const std::vector<glm::dvec3>& points_;
  double step_m_, least_over_ = 0.0;
  MeshShift best_;
};

}  // namespace

MeshShift shift_to_terrain(const HeightfieldTruth& truth, const std::vector<glm::dvec3>& points) {
  return Search(truth, points).run();
}

}  // namespace plumb::audit
