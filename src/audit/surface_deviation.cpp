#include "audit/surface_deviation.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "audit/cover_row.h"
#include "audit/flat_triangle.h"
#include "audit/row_bins.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

using terrain::Heightfield;

constexpr int kBandRows = 16;  // rows of samples that one task owns

// Bits of floats >= 0 order as the floats do. Several bands may hold parts of a triangle; a maximum
// has no order.
void raise_to(float& most, double distance) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(static_cast<float>(distance));
  std::atomic_ref<std::uint32_t> shared(reinterpret_cast<std::uint32_t&>(most));
  std::uint32_t seen = shared.load(std::memory_order_relaxed);
  while (seen < bits && !shared.compare_exchange_weak(seen, bits, std::memory_order_relaxed)) {
  }
}

struct Range {
  int first, last;
};

// Grid lines within [low, high] metres, one more where rounding could matter, cut to [least, most].
Range lines_within(double low, double high, double lines_per_metre, int least, int most) {
  const double first =
      std::clamp(low * lines_per_metre - kNearLine, static_cast<double>(least), most + 1.0);
  const double last =
      std::clamp(high * lines_per_metre + kNearLine, least - 1.0, static_cast<double>(most));
  // Up and down to whole numbers, without a call.
  const int up = static_cast<int>(first), down = static_cast<int>(last);
  return {up + (up < first), down - (down > last)};
}

// Where the triangle begins and ends along the line y, metres.
struct Reach {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(const glm::dvec3& p, const glm::dvec3& q, double y) {
    if (std::min(p.y, q.y) > y || std::max(p.y, q.y) < y) return;
    const double share = p.y == q.y ? 0.0 : (y - p.y) / (q.y - p.y);
    const double at = p.x + share * (q.x - p.x);
    low = std::min(low, p.y == q.y ? std::min(p.x, q.x) : at);
    high = std::max(high, p.y == q.y ? std::max(p.x, q.x) : at);
  }
};

// Lays triangles over the samples of a band of rows.
class BandCover {
 public:
  BandCover(const Heightfield& field, Range rows)
      : field_(field),
        rows_(rows),
        stride_(static_cast<std::size_t>(field.columns()) + CoverRow::kPadding),
        columns_per_m_(1.0 / field.dx_m),
        rows_per_m_(1.0 / field.dy_m),
        cover_(cover_samples(instruction_set())),
        heights_m_(stride_ * static_cast<std::size_t>(rows.last - rows.first + 1)),
        delta_m_(heights_m_.size(), 0.0),
        triangle_(heights_m_.size(), -1.0),
        sheets_(heights_m_.size(), 0.0) {
    for (int j = rows.first; j <= rows.last; ++j) {
      float* row = heights_m_.data() + offset(j);
      for (int i = 0; i < field.columns(); ++i) row[i] = field.heights_m(i, j);
    }
  }

  // Returns the largest distance from a sample that it covers, metres.
  double add(const FlatTriangle& t, std::uint32_t index) {
    const double y0 = std::min({t.a.y, t.b.y, t.c.y}), y1 = std::max({t.a.y, t.b.y, t.c.y});
    const Range own = lines_within(y0, y1, rows_per_m_, rows_.first, rows_.last);
    const Range box =
        columns_within(std::min({t.a.x, t.b.x, t.c.x}), std::max({t.a.x, t.b.x, t.c.x}));
    const CoverTriangle triangle{t.a.x,
                                 t.a.y,
                                 t.a.z,
                                 t.b.x,
                                 t.b.y,
                                 t.b.z,
                                 t.c.x,
                                 t.c.y,
                                 t.c.z,
                                 t.slack,
                                 static_cast<double>(index)};
    // Where the box holds few samples, to ask for the reach of each row costs more than it saves.
    const bool narrow = box.last - box.first < CoverRow::kPadding;
    double largest = 0.0;
    for (int j = own.first; j <= own.last; ++j) {
      const double y = j * field_.dy_m;
      // The line is moved into the triangle where it misses it by a rounding.
      const Range columns = narrow ? box : reach_of(t, std::clamp(y, y0, y1));
      const std::ptrdiff_t at = offset(j);
      const CoverRow row{y,
                         field_.dx_m,
                         heights_m_.data() + at,
                         delta_m_.data() + at,
                         triangle_.data() + at,
                         sheets_.data() + at};
      largest = std::max(largest, cover_(triangle, row, columns.first, columns.last));
    }
    return largest;
  }

  DeviationRow row(int j) const {
    const std::ptrdiff_t at = offset(j);
    return {heights_m_.data() + at, delta_m_.data() + at, triangle_.data() + at,
            sheets_.data() + at};
  }

 private:
  std::ptrdiff_t offset(int j) const {
    return static_cast<std::ptrdiff_t>(static_cast<std::size_t>(j - rows_.first) * stride_);
  }

  Range columns_within(double low, double high) const {
    return lines_within(low, high, columns_per_m_, 0, field_.columns() - 1);
  }

  Range reach_of(const FlatTriangle& t, double y) const {
    Reach reach;
    reach.add(t.a, t.b, y);
    reach.add(t.b, t.c, y);
    reach.add(t.c, t.a, y);
    return columns_within(reach.low, reach.high);
  }

  const Heightfield& field_;
  Range rows_;
  std::size_t stride_;
  double columns_per_m_, rows_per_m_;
  CoverSamples cover_;
  std::vector<float> heights_m_;  // of these rows, padded
  std::vector<double> delta_m_, triangle_, sheets_;
};

}  // namespace

void for_each_sample_row(const Heightfield& field, const TriangleMesh& mesh,
                         std::vector<float>* triangle_max_m,
                         const std::function<void(int, const DeviationRow&)>& visit) {
  const glm::dvec3 shift = mesh.origin_m - field.world_origin_m();
  if (triangle_max_m != nullptr) triangle_max_m->assign(mesh.triangles.size(), 0.0f);
  const int bands = (field.rows() + kBandRows - 1) / kBandRows;
  const RowBins bins(mesh, shift.y, kBandRows * field.dy_m, bands, kNearLine * field.dy_m);
  parallel_for(bands, 1, [&](std::int64_t band) {
    const int first = static_cast<int>(band) * kBandRows,
              last = std::min(first + kBandRows, field.rows()) - 1;
    BandCover cover(field, {first, last});
    for (const std::uint32_t index : bins.triangles(static_cast<int>(band))) {
      const FlatTriangle t = flat_triangle(mesh, index, shift);
      if (!t.is_flat()) continue;
      const double largest = cover.add(t, index);
      if (triangle_max_m != nullptr) raise_to((*triangle_max_m)[index], largest);
    }
    for (int j = first; j <= last; ++j) visit(j, cover.row(j));
  });
}

}  // namespace plumb::audit
