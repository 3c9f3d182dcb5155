#include "mesh/dual_contouring/density.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::mesh::dual_contouring {
namespace {

using terrain::Material;
using terrain::StackField;
using terrain::StackView;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kColumns = 16;  // side by side: a cache line of floats

// Heights in voxels of the level.
struct Run {
  double start = 0.0, end = 0.0;
};

// Layers that count, from the bottom up; those that touch are one. The lowest has no start.
template <class Counts>
void runs_of(const StackView& stack, double voxel_m, const Counts& counts, std::vector<Run>& runs) {
  const double low_m = stack.low_m;
  runs.clear();
  bool touches = false;
  for (std::size_t k = 0; k < stack.size(); ++k) {
    const bool counted = counts(stack.material[k]);
    const double end = (double{stack.end_m[k]} - low_m) / voxel_m;
    if (counted && touches) runs.back().end = end;
    if (counted && !touches)
      runs.push_back({k == 0 ? -kInfinity : (double{stack.end_m[k - 1]} - low_m) / voxel_m, end});
    touches = counted;
  }
}

// Voxels of one stack from the bottom up, `kColumns` floats apart. The coverage of a voxel that
// several runs touch is summed in double.
class ColumnFill {
 public:
  ColumnFill(float* voxels, int low, int high) : voxels_(voxels), low_(low), high_(high) {}

  void add(const Run& run) {
    const double low = low_, high = high_;
    if (!(run.end > low) || !(run.start < high)) return;
    const double start = std::max(run.start, low), end = std::min(run.end, high);
    const int first = static_cast<int>(std::floor(start)), last = static_cast<int>(std::floor(end));
    if (first == last) return cover(first, end - start);
    cover(first, 1.0 - (start - first));
    for (int k = first + 1; k < last; ++k) at(k) = 1.0F;
    if (last < high_) cover(last, end - last);
  }

 private:
  float& at(int k) { return voxels_[static_cast<std::size_t>(k - low_) * kColumns]; }
  void cover(int k, double part) {
    covered_ = k == voxel_ ? covered_ + part : part;
    voxel_ = k;
    at(k) = static_cast<float>(covered_);
  }

  float* voxels_;
  int low_, high_;
  int voxel_ = std::numeric_limits<int>::min();  // the last that was covered in part
  double covered_ = 0.0;
};

template <class Counts>
Lattice<float> coverage(const StackField& level, const LatticeBox& box,
                        const NearestStacks& nearest, const Counts& counts) {
  Lattice<float> density(box);
  if (density.values().empty()) return density;
  const glm::ivec3 high = box.high();
  const auto width = static_cast<std::size_t>(box.size.x);
  const std::size_t samples = width * static_cast<std::size_t>(box.size.z);
  parallel_for(box.size.y, slices_a_task(samples), [&](std::int64_t y) {
    const int j = box.low.y + static_cast<int>(y);
    std::vector<float> columns(static_cast<std::size_t>(box.size.z) * kColumns);
    std::vector<Run> runs;
    for (std::size_t x = 0; x < width; x += kColumns) {
      const std::size_t count = std::min(kColumns, width - x);
      std::fill(columns.begin(), columns.end(), 0.0F);
      for (std::size_t c = 0; c < count; ++c) {
        const std::size_t stack = nearest.at(box.low.x + static_cast<int>(x + c), j);
        const auto row_length = static_cast<std::size_t>(level.columns);
        runs_of(
            level.stack(static_cast<int>(stack % row_length), static_cast<int>(stack / row_length)),
            level.voxel_m, counts, runs);
        ColumnFill fill(columns.data() + c, box.low.z, high.z);
        for (const Run& run : runs) fill.add(run);
      }
      for (int k = box.low.z; k < high.z; ++k)
        std::copy_n(columns.data() + static_cast<std::size_t>(k - box.low.z) * kColumns, count,
                    density.row(j, k).data() + x);
    }
  });
  return density;
}

}  // namespace

Lattice<float> density_of(const StackField& level, const LatticeBox& box,
                          const NearestStacks& nearest) {
  return coverage(level, box, nearest, [](Material m) { return m != terrain::kAir; });
}

Lattice<float> density_of(const StackField& level, const LatticeBox& box) {
  return density_of(level, box, NearestStacks(level));
}

Lattice<float> material_density_of(const StackField& level, Material material,
                                   const LatticeBox& box, const NearestStacks& nearest) {
  require(material != terrain::kAir && material < level.materials.size(),
          "material must be one of {} and not air, got {}", level.materials.size(), material);
  return coverage(level, box, nearest, [&](Material m) { return m == material; });
}

Lattice<float> material_density_of(const StackField& level, Material material,
                                   const LatticeBox& box) {
  return material_density_of(level, material, box, NearestStacks(level));
}

}  // namespace plumb::mesh::dual_contouring
