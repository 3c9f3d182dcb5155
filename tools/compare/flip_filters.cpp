#include "compare/flip_filters.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/reproducible_math.h"

namespace plumb::compare {
namespace {

// Of the eye's sensitivity to a frequency, a sum of Gaussians a sqrt(pi / b) exp(-pi^2 d^2 / b)
// over the distance d in degrees.
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kLuminanceSeen{1.0, 0.0047}, kRedGreenSeen{1.0, 0.0053};
constexpr Sensitivity kBlueYellowSeen[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kFeatureWidth_deg = 0.082;  // between the two slopes of an edge detector

double sum_of(const std::vector<double>& half) {
  double sum = half[0];
  for (std::size_t k = 1; k < half.size(); ++k) sum += 2.0 * half[k];
  return sum;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

std::vector<double> gaussian(int reach, double pixels_per_degree, double b) {
  std::vector<double> half;
  for (int k = 0; k <= reach; ++k) {
    const double distance_deg = k / pixels_per_degree;
    half.push_back(reproducible_exp(-(kPi * kPi) * distance_deg * distance_deg / b));
  }
  return half;
}

// The sum of two Gaussians in two dimensions is not separable, each of them is. The factor before
// each is shared out among its two directions.
void add_blue_yellow(FlipFilters& filters, double pixels_per_degree) {
  std::array<std::vector<double>, 2> halves;
  double sum = 0.0;
  for (int k = 0; k < 2; ++k) {
    const auto [a, b] = kBlueYellowSeen[k];
    halves[k] =
        scaled(gaussian(filters.reach, pixels_per_degree, b), std::sqrt(a * std::sqrt(kPi / b)));
    sum += sum_of(halves[k]) * sum_of(halves[k]);
  }
  filters.half[kBlueYellowA] = scaled(halves[0], 1.0 / std::sqrt(sum));
  filters.half[kBlueYellowB] = scaled(halves[1], 1.0 / std::sqrt(sum));
}

void add_detectors(FlipFilters& filters, double deviation_px, int radius) {
  const auto size = static_cast<std::size_t>(filters.reach) + 1;
  std::vector<double> gauss(size, 0.0), edge(size, 0.0), point(size, 0.0);
  double edge_sum = 0.0, above = 0.0, below = 0.0;
  for (int k = 0; k <= radius; ++k) {
    const double x = k / deviation_px;
    gauss[k] = reproducible_exp(-0.5 * x * x);
    edge[k] = k * gauss[k];
    point[k] = (x * x - 1.0) * gauss[k];
    edge_sum += edge[k];
    (point[k] > 0.0 ? above : below) += (k == 0 ? 1.0 : 2.0) * std::abs(point[k]);
  }
  for (double& value : edge) value /= edge_sum;
  for (double& value : point) value /= value > 0.0 ? above : below;
  filters.half[kGauss] = scaled(gauss, 1.0 / sum_of(gauss));
  filters.half[kEdge] = edge;
  filters.half[kPoint] = point;
}

using Matrix = std::array<double, 9>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int i = 0; i < 9; ++i) {
    for (int k = 0; k < 3; ++k) c[i] += a[i / 3 * 3 + k] * b[k * 3 + i % 3];
  }
  return c;
}

Matrix inverse(const Matrix& m) {
  Matrix adjugate{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      adjugate[i * 3 + j] = m[a * 3 + c] * m[b * 3 + d] - m[a * 3 + d] * m[b * 3 + c];
    }
  }
  const double determinant = m[0] * adjugate[0] + m[1] * adjugate[3] + m[2] * adjugate[6];
  for (double& value : adjugate) value /= determinant;
  return adjugate;
}

// Rec. 709 primaries and D65; each row over its sum, which is white's X, Y or Z.
Matrix rgb_to_xyz() {
  Matrix m{10135552.0, 8788810.0, 4435075.0, 2613072.0, 8788810.0,
           887015.0,   1425312.0, 8788810.0, 70074185.0};
  for (int row = 0; row < 3; ++row) {
    const double sum = m[3 * row] + m[3 * row + 1] + m[3 * row + 2];
    for (int k = 0; k < 3; ++k) m[3 * row + k] /= sum;
  }
  return m;
}

std::array<double, 3> hunt_lab(int primary) {
  const Matrix m = rgb_to_xyz();
  double f[3];
  for (int c = 0; c < 3; ++c) {
    const double t = m[3 * c + primary];
    f[c] = t > 216.0 / 24389.0 ? reproducible_pow(t, 1.0 / 3.0) : t * 841.0 / 108.0 + 4.0 / 29.0;
  }
  const double lightness = 116.0 * f[1] - 16.0, hunt = 0.01 * lightness;
  return {lightness, hunt * 500.0 * (f[0] - f[1]), hunt * 200.0 * (f[1] - f[2])};
}

FlipConstants make_constants() {
  const Matrix xyz = rgb_to_xyz();
  const Matrix opponent = product({0, 1, 0, 1, -1, 0, 0, 1, -1}, xyz), back = inverse(opponent);
  FlipConstants constants{};
  for (int k = 0; k < 9; ++k) {
    constants.to_xyz[k] = static_cast<float>(xyz[k]);
    constants.to_opponent[k] = static_cast<float>(opponent[k]);
    constants.from_opponent[k] = static_cast<float>(back[k]);
  }
  const double largest = flip_largest_difference(), knee = 0.4 * largest, share = 0.95;
  const double steep = (1.0 - share) / (largest - knee);
  constants.gentle = static_cast<float>(share / knee);
  constants.steep = static_cast<float>(steep);
  constants.knee = static_cast<float>(knee);
  constants.offset = static_cast<float>(share - steep * knee);
  return constants;
}

}  // namespace

FlipFilters flip_filters(double pixels_per_degree) {
  require(pixels_per_degree >= 1.0 && pixels_per_degree <= 1000.0,
          "pixels_per_degree must be in [1, 1000], got {}", pixels_per_degree);
  const double widest_b = kBlueYellowSeen[0].b;
  const double widest_px = std::sqrt(widest_b / (2.0 * kPi * kPi)) * pixels_per_degree;
  const double feature_px = 0.5 * kFeatureWidth_deg * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * widest_px));
  const int feature_radius = static_cast<int>(std::ceil(3.0 * feature_px));

  FlipFilters filters;
  filters.reach = radius;  // the wider: 3 * 0.0450 degrees beside 3 * 0.041
  for (const auto& [filter, seen] :
       {std::pair{kLuminance, kLuminanceSeen}, std::pair{kRedGreen, kRedGreenSeen}}) {
    const std::vector<double> half = gaussian(radius, pixels_per_degree, seen.b);
    filters.half[filter] = scaled(half, 1.0 / sum_of(half));
  }
  add_blue_yellow(filters, pixels_per_degree);
  add_detectors(filters, feature_px, feature_radius);
  for (int k = 0; k <= filters.reach; ++k) {
    for (const std::vector<double>& half : filters.half)
      filters.lanes.insert(filters.lanes.end(), kFlipLanes, static_cast<float>(half[k]));
  }
  return filters;
}

double flip_largest_difference() {
  const std::array<double, 3> green = hunt_lab(1), blue = hunt_lab(2);
  const double a = green[1] - blue[1], b = green[2] - blue[2];
  return reproducible_pow(std::abs(green[0] - blue[0]) + std::sqrt(a * a + b * b), 0.7);
}

const FlipConstants& flip_constants() {
  static const FlipConstants kConstants = make_constants();
  return kConstants;
}

}  // namespace plumb::compare
