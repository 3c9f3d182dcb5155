// FLIP as its papers write it: in double precision, with the C library's functions, whole filters
// in two dimensions and nothing shared out or shortened. Slow.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace plumb::testing {

struct SlowPicture {
  int width = 0, height = 0;
  std::vector<glm::dvec3> pixels;

  const glm::dvec3& clamped(int x, int y) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return pixels[static_cast<std::size_t>(y) * width + x];
  }
  SlowPicture map(const std::function<glm::dvec3(const glm::dvec3&)>& change) const {
    SlowPicture changed{width, height, {}};
    for (const glm::dvec3& pixel : pixels) changed.pixels.push_back(change(pixel));
    return changed;
  }
};

inline double slow_linear(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
inline glm::dvec3 slow_linear(const glm::dvec3& s) {
  return {slow_linear(s.x), slow_linear(s.y), slow_linear(s.z)};
}

// glm's matrices are written column by column.
inline glm::dmat3 slow_xyz_of_rgb() {
  return glm::transpose(
      glm::dmat3(10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0,
                 2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,
                 1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0));
}
inline const glm::dvec3 kSlowWhite = slow_xyz_of_rgb() * glm::dvec3(1.0);

inline glm::dvec3 slow_ycxcz(const glm::dvec3& linear) {
  const glm::dvec3 t = slow_xyz_of_rgb() * linear / kSlowWhite;
  return {116.0 * t.y - 16.0, 500.0 * (t.x - t.y), 200.0 * (t.y - t.z)};
}
inline glm::dvec3 slow_rgb_of_ycxcz(const glm::dvec3& c) {
  const double y = (c.x + 16.0) / 116.0;
  const glm::dvec3 xyz = glm::dvec3(y + c.y / 500.0, y, y - c.z / 200.0) * kSlowWhite;
  return glm::inverse(slow_xyz_of_rgb()) * xyz;
}

inline glm::dvec3 slow_hunt_lab(const glm::dvec3& linear) {
  const glm::dvec3 t = slow_xyz_of_rgb() * linear / kSlowWhite;
  const auto f = [](double v) {
    const double d = 6.0 / 29.0;
    return v > d * d * d ? std::cbrt(v) : v / (3.0 * d * d) + 4.0 / 29.0;
  };
  const double l = 116.0 * f(t.y) - 16.0;
  return {l, 0.01 * l * 500.0 * (f(t.x) - f(t.y)), 0.01 * l * 200.0 * (f(t.y) - f(t.z))};
}

inline double slow_hyab(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

inline double slow_redistributed(double hyab) {
  const double most = std::pow(slow_hyab(slow_hunt_lab({0, 1, 0}), slow_hunt_lab({0, 0, 1})), 0.7);
  const double d = std::pow(hyab, 0.7), knee = 0.4 * most;
  return d < knee ? 0.95 * d / knee : 0.95 + 0.05 * (d - knee) / (most - knee);
}

// A square filter of 2 radius + 1 taps a side.
struct SlowKernel {
  int radius = 0;
  std::vector<double> weights;

  SlowKernel(int reach, const std::function<double(int, int)>& weight) : radius(reach) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) weights.push_back(weight(x, y));
    }
  }
  // Positive weights sum to 1 and negative ones to -1.
  SlowKernel normalised() const {
    double above = 0.0, below = 0.0;
    for (const double w : weights) (w > 0.0 ? above : below) += std::abs(w);
    SlowKernel kernel = *this;
    for (double& w : kernel.weights) {
      if (w != 0.0) w /= w > 0.0 ? above : below;
    }
    return kernel;
  }
  double at(const SlowPicture& picture, int channel, int x, int y) const {
    double sum = 0.0;
    std::size_t k = 0;
    for (int j = -radius; j <= radius; ++j) {
      for (int i = -radius; i <= radius; ++i)
        sum += weights[k++] * picture.clamped(x + i, y + j)[channel];
    }
    return sum;
  }
};

struct SlowFilters {
  std::vector<SlowKernel> colour, detectors;  // of Y, Cx, Cz; edges and points in x and y
};

inline SlowFilters slow_filters(double pixels_per_degree) {
  const double pi = 3.14159265358979323846;
  const double a[3][2] = {{1.0, 0.0}, {1.0, 0.0}, {34.1, 13.5}};
  const double b[3][2] = {{0.0047, 1e-5}, {0.0053, 1e-5}, {0.04, 0.025}};
  SlowFilters filters;
  const int reach =
      static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * pixels_per_degree));
  for (int c = 0; c < 3; ++c) {
    const SlowKernel kernel(reach, [&](int x, int y) {
      const double square = (x * x + y * y) / (pixels_per_degree * pixels_per_degree);
      double sum = 0.0;
      for (int k = 0; k < 2; ++k)
        sum += a[c][k] * std::sqrt(pi / b[c][k]) * std::exp(-pi * pi * square / b[c][k]);
      return sum;
    });
    filters.colour.push_back(kernel.normalised());
  }
  const double s = 0.5 * 0.082 * pixels_per_degree;
  const int feature_reach = static_cast<int>(std::ceil(3.0 * s));
  const auto gauss = [s](int x, int y) { return std::exp(-(x * x + y * y) / (2.0 * s * s)); };
  const auto edge = [&](int x, int y) { return -x * gauss(x, y); };
  const auto point = [&](int x, int y) { return (x * x / (s * s) - 1.0) * gauss(x, y); };
  const auto across = [](const auto& f) { return [f](int x, int y) { return f(y, x); }; };
  for (const std::function<double(int, int)>& f :
       std::initializer_list<std::function<double(int, int)>>{edge, across(edge), point,
                                                              across(point)})
    filters.detectors.push_back(SlowKernel(feature_reach, f).normalised());
  return filters;
}

// Errors of two pictures in linear light, 0..1, row by row.
inline std::vector<double> slow_flip(const SlowPicture& reference, const SlowPicture& candidate,
                                     double pixels_per_degree) {
  const SlowFilters filters = slow_filters(pixels_per_degree);
  const SlowPicture pictures[] = {reference.map(slow_ycxcz), candidate.map(slow_ycxcz)};
  const auto grey = [](const glm::dvec3& c) { return glm::dvec3((c.x + 16.0) / 116.0); };
  const SlowPicture greys[] = {pictures[0].map(grey), pictures[1].map(grey)};
  std::vector<double> errors;
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      glm::dvec3 lab[2];
      double edge[2], point[2];
      for (int k = 0; k < 2; ++k) {
        glm::dvec3 seen;
        for (int c = 0; c < 3; ++c) seen[c] = filters.colour[c].at(pictures[k], c, x, y);
        lab[k] = slow_hunt_lab(glm::clamp(slow_rgb_of_ycxcz(seen), 0.0, 1.0));
        double answer[4];
        for (int d = 0; d < 4; ++d) answer[d] = filters.detectors[d].at(greys[k], 0, x, y);
        edge[k] = std::hypot(answer[0], answer[1]);
        point[k] = std::hypot(answer[2], answer[3]);
      }
      const double colour = slow_redistributed(slow_hyab(lab[0], lab[1]));
      const double larger = std::max(std::abs(edge[0] - edge[1]), std::abs(point[0] - point[1]));
      errors.push_back(std::pow(colour, 1.0 - std::sqrt(larger / std::sqrt(2.0))));
    }
  }
  return errors;
}

// Narkowicz's fit of ACES, its exposure of 0.6 taken out, cut to 0..1.
inline double slow_aces(double x) {
  x = 0.6 * std::max(x, 0.0);
  return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}
// Hable's curve with an exposure of 2 and white at 11.2, cut to 0..1.
inline double slow_hable(double x) {
  const auto curve = [](double v) {
    return (v * (0.15 * v + 0.1 * 0.5) + 0.2 * 0.02) / (v * (0.15 * v + 0.5) + 0.2 * 0.3) -
           0.02 / 0.3;
  };
  return std::clamp(curve(2.0 * std::max(x, 0.0)) / curve(11.2), 0.0, 1.0);
}

}  // namespace plumb::testing
