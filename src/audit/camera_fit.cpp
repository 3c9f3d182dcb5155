#include "audit/camera_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "audit/plan_fit.h"

namespace plumb::audit {
namespace {

constexpr std::size_t kUnknowns = 7;  // eye, turn about right, up and forward, magnification
using Step = std::array<double, kUnknowns>;

// A rotation by |turn| radians about it; exact enough for small ones, and made orthonormal again.
void turn_axes(const glm::dvec3& turn, Camera& camera) {
  const glm::dvec3 world = turn.x * camera.right + turn.y * camera.up + turn.z * camera.forward;
  const auto turned = [&](const glm::dvec3& axis) { return axis + glm::cross(world, axis); };
  const glm::dvec3 forward = glm::normalize(turned(camera.forward));
  glm::dvec3 right = turned(camera.right);
  right = glm::normalize(right - glm::dot(right, forward) * forward);
  const glm::dvec3 up = glm::cross(right, forward);
  camera.up = glm::dot(up, camera.up) < 0.0 ? -up : up;
  camera.right = right;
  camera.forward = forward;
}

Camera moved(Camera camera, const Step& by) {
  camera.eye_m += by[0] * camera.right + by[1] * camera.up + by[2] * camera.forward;
  turn_axes({by[3], by[4], by[5]}, camera);
  camera.gamma_h *= 1.0 + by[6];
  camera.gamma_v *= 1.0 + by[6];
  return camera;
}

// The frame's depth less the truth's, relative; NaN where one of them shows no ground.
std::vector<double> residuals(const DepthSamples& samples, const DepthRanges& ranges,
                              const Camera& camera) {
  std::vector<double> left = samples.depths_through(camera);
  for (std::size_t k = 0; k < left.size(); ++k) {
    const bool ground = ranges[k] && !ranges[k]->is_sky();
    const double drawn = ground ? ranges[k]->value : std::numeric_limits<double>::quiet_NaN();
    left[k] = 2.0 * (drawn - left[k]) / (drawn + left[k]);  // NaN for a truth that is infinite
  }
  return left;
}

// Solves A x = b, A symmetric and positive, by elimination.
Step solved(std::array<Step, kUnknowns> a, Step b) {
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    for (std::size_t r = i + 1; r < kUnknowns; ++r) {
      const double factor = a[r][i] / a[i][i];
      for (std::size_t c = i; c < kUnknowns; ++c) a[r][c] -= factor * a[i][c];
      b[r] -= factor * b[i];
    }
  }
  for (std::size_t i = kUnknowns; i-- > 0;) {
    for (std::size_t c = i + 1; c < kUnknowns; ++c) b[i] -= a[i][c] * b[c];
    b[i] /= a[i][i];
  }
  return b;
}

class Search {
 public:
  Search(const DepthSamples& samples, const DepthRanges& ranges, const Camera& stated)
      : samples_(samples), ranges_(ranges), best_(stated) {
    std::vector<double> depths;
    for (const double depth : samples.true_depths())
      if (std::isfinite(depth)) depths.push_back(depth);
    const double far_m = std::max(1.0, middle_of(std::move(depths)));
    unit_ = {far_m, far_m, far_m, 1.0, 1.0, 1.0, 1.0};
    best_mean_ = mean_of(best_);
  }

  Camera run() {
    double damping = 1e-3;
    constexpr int kRounds = 25;
    for (int round = 0; round < kRounds && damping < 1e6; ++round) {
      if (!is_linear_) linearise();
      const Camera next = moved(best_, step(damping));
      const double mean = mean_of(next);
      if (!(mean < best_mean_)) {
        damping *= 10.0;
        continue;
      }
      const bool done = mean > 0.9999 * best_mean_;
      best_ = next;
      best_mean_ = mean;
      is_linear_ = false;
      damping = std::max(1e-9, 0.2 * damping);
      if (done) break;
    }
    return best_;
  }

 private:
  // Over the pixels that either shows ground in; one where one alone does.
  double mean_of(const Camera& camera) const {
    return difference_of(ranges_, samples_.depths_through(camera)).mean;
  }

  // Sums of the weighted normal equations around the best camera.
  void linearise() {
    const std::vector<double> here = residuals(samples_, ranges_, best_);
    std::array<std::vector<double>, kUnknowns> slopes;
    constexpr double kSmall = 1e-4;
    for (std::size_t u = 0; u < kUnknowns; ++u) {
      Step by{};
      by[u] = kSmall * unit_[u];
      slopes[u] = residuals(samples_, ranges_, moved(best_, by));
      for (std::size_t k = 0; k < here.size(); ++k)
        slopes[u][k] = (slopes[u][k] - here[k]) / kSmall;
    }
    normal_ = {};
    right_ = {};
    for (std::size_t k = 0; k < here.size(); ++k) {
      // At an outline a small step changes what is seen: no slope.
      const bool usable = std::isfinite(here[k]) &&
                          std::all_of(slopes.begin(), slopes.end(), [&](const auto& slope) {
                            return std::abs(slope[k]) < kSteepest;
                          });
      if (!usable) continue;
      const double weight = 1.0 / (std::abs(here[k]) + 1e-4);
      for (std::size_t a = 0; a < kUnknowns; ++a) {
        right_[a] -= weight * slopes[a][k] * here[k];
        for (std::size_t b = 0; b < kUnknowns; ++b)
          normal_[a][b] += weight * slopes[a][k] * slopes[b][k];
      }
    }
    is_linear_ = true;
  }

  Step step(double damping) const {
    auto damped = normal_;
    for (std::size_t u = 0; u < kUnknowns; ++u)
      damped[u][u] = (1.0 + damping) * damped[u][u] + 1e-12;
    Step by = solved(damped, right_);
    for (std::size_t u = 0; u < kUnknowns; ++u)
      by[u] = std::clamp(by[u], -kLongest, kLongest) * unit_[u];
    return by;
  }

  static constexpr double kSteepest = 200.0;  // relative depth per unit
  static constexpr double kLongest = 0.2;     // of a step: of the middle depth, in radians

  const DepthSamples& samples_;
  const DepthRanges& ranges_;
  Camera best_;
  double best_mean_ = 0.0;
  Step unit_{};
  bool is_linear_ = false;
  std::array<Step, kUnknowns> normal_{};
  Step right_{};
};

}  // namespace

Camera fitted_camera(const DepthSamples& samples, const DepthRanges& ranges, const Camera& stated) {
  return Search(samples, ranges, stated).run();
}

std::string camera_text(const Camera& fitted, const Camera& stated) {
  constexpr double kDegreesOfRadian = 57.29577951308232;
  std::vector<std::string> parts;
  glm::dvec3 by = fitted.eye_m - stated.eye_m;
  for (int axis = 0; axis < 3; ++axis)  // what is less than a millimetre is nothing
    by[axis] = std::abs(by[axis]) < 1e-3 ? 0.0 : by[axis];
  if (glm::length(by) >= 1e-3)
    parts.push_back(fmt::format(
        "its eye stands ({:.4g}, {:.4g}, {:.4g}) m from the stated place (east, north, up)", by.x,
        by.y, by.z));
  // Twice the sine of half the angle: the longest way that an axis's end moves.
  const double turned =
      std::max({glm::length(fitted.forward - stated.forward), glm::length(fitted.up - stated.up),
                glm::length(fitted.right - stated.right)});
  if (turned >= 1e-4)
    parts.push_back(fmt::format("it is turned by {:.3g} degrees against the stated way",
                                turned * kDegreesOfRadian));
  const double wider = stated.gamma_v / fitted.gamma_v;
  if (std::abs(wider - 1.0) >= 1e-4)
    parts.push_back(
        fmt::format("the tangent of its angle of view is {:.4g} times the stated one's", wider));
  if (parts.empty()) return "its camera is the stated one";
  return "its camera is another: " + fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace plumb::audit
