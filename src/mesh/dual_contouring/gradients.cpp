#include "mesh/dual_contouring/gradients.h"

#include <algorithm>
#include <cstddef>

namespace plumb::mesh::dual_contouring {
namespace {

// Whether `count` samples a side, from `low` up, and all their neighbours lie in the lattice.
bool is_interior(const LatticeBox& box, const glm::ivec3& low, int count) {
  const LatticeBox inner = box.grown(-1);
  return inner.contains(low) && inner.contains(low + (count - 1));
}

double at_border(const Lattice<float>& density, const glm::ivec3& p) {
  const glm::ivec3 low = density.box().low, high = density.box().high() - 1;
  return density({std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y),
                  std::clamp(p.z, low.z, high.z)});
}

double smooth(double before, double here, double after) { return before + 2.0 * here + after; }

// Sobel's sums of N x N x N samples, along x, then y, then z, so that neighbours share them.
template <int N>
class SobelBlock {
 public:
  SobelBlock(const Lattice<float>& density, const glm::ivec3& low) {
    const bool interior = is_interior(density.box(), low, N);
    for (int z = 0; z < kWide; ++z) {
      for (int y = 0; y < kWide; ++y) {
        const glm::ivec3 first = low + glm::ivec3(-1, y - 1, z - 1);
        double row[kWide];
        const float* in = interior ? &density(first) : nullptr;
        for (int x = 0; x < kWide; ++x)
          row[x] = interior ? double{in[x]} : at_border(density, first + glm::ivec3(x, 0, 0));
        add_row(z, y, row);
      }
      add_slice(z);
    }
  }

  glm::dvec3 gradient(int x, int y, int z) const {
    return glm::dvec3(smooth(x_[z][y][x], x_[z + 1][y][x], x_[z + 2][y][x]),
                      smooth(y_[z][y][x], y_[z + 1][y][x], y_[z + 2][y][x]),
                      z_[z + 2][y][x] - z_[z][y][x]) /
           32.0;
  }

 private:
  static constexpr int kWide = N + 2;

  void add_row(int z, int y, const double* row) {
    for (int x = 0; x < N; ++x) {
      differ_[z][y][x] = row[x + 2] - row[x];
      smooth_[z][y][x] = smooth(row[x], row[x + 1], row[x + 2]);
    }
  }
  void add_slice(int z) {
    for (int y = 0; y < N; ++y) {
      for (int x = 0; x < N; ++x) {
        const auto &d = differ_[z], &s = smooth_[z];
        x_[z][y][x] = smooth(d[y][x], d[y + 1][x], d[y + 2][x]);
        y_[z][y][x] = s[y + 2][x] - s[y][x];
        z_[z][y][x] = smooth(s[y][x], s[y + 1][x], s[y + 2][x]);
      }
    }
  }

  double differ_[kWide][kWide][N], smooth_[kWide][kWide][N];  // along x
  double x_[kWide][N][N], y_[kWide][N][N], z_[kWide][N][N];   // along x and y
};

}  // namespace

glm::dvec3 central_gradient(const Lattice<float>& density, const glm::ivec3& sample) {
  const LatticeBox& box = density.box();
  glm::dvec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 before = sample, after = sample;
    before[axis] = std::max(sample[axis] - 1, box.low[axis]);
    after[axis] = std::min(sample[axis] + 1, box.high()[axis] - 1);
    const int apart = after[axis] - before[axis];
    gradient[axis] = apart == 0 ? 0.0 : (double{density(after)} - double{density(before)}) / apart;
  }
  return gradient;
}

std::array<glm::dvec3, 8> central_gradients(const Lattice<float>& density, const glm::ivec3& cell) {
  std::array<glm::dvec3, 8> gradients;
  const bool interior = is_interior(density.box(), cell, 2);
  const std::ptrdiff_t row = density.box().size.x, slice = row * density.box().size.y;
  for (int c = 0; c < 8; ++c) {
    const glm::ivec3 sample = cell + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
    glm::dvec3& gradient = gradients[static_cast<std::size_t>(c)];
    if (!interior) {
      gradient = central_gradient(density, sample);
      continue;
    }
    const float* at = &density(sample);
    gradient = glm::dvec3(double{at[1]} - double{at[-1]}, double{at[row]} - double{at[-row]},
                          double{at[slice]} - double{at[-slice]}) /
               2.0;
  }
  return gradients;
}

glm::dvec3 sobel_gradient(const Lattice<float>& density, const glm::ivec3& sample) {
  return SobelBlock<1>(density, sample).gradient(0, 0, 0);
}

std::array<glm::dvec3, 8> sobel_gradients(const Lattice<float>& density, const glm::ivec3& cell) {
  const SobelBlock<2> block(density, cell);
  std::array<glm::dvec3, 8> gradients;
  for (int c = 0; c < 8; ++c)
    gradients[static_cast<std::size_t>(c)] = block.gradient(c & 1, c >> 1 & 1, c >> 2);
  return gradients;
}

}  // namespace plumb::mesh::dual_contouring
