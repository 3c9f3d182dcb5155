#include "audit/surface_deviation.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "audit/flat_triangle.h"
#include "audit/row_bins.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

using terrain::Heightfield;

constexpr int kBandRows = 32;       // rows of samples that one task owns
constexpr double kNearLine = 1e-6;  // cells by which a search reaches beyond a triangle's box

FlatTriangle flat_triangle(const TriangleMesh& mesh, std::uint32_t index, const glm::dvec3& shift) {
  const Triangle& t = mesh.triangles[index];
  return {mesh.vertices_m[t[0]] + shift, mesh.vertices_m[t[1]] + shift,
          mesh.vertices_m[t[2]] + shift};
}

void keep_worst(Deviation& worst, double delta, std::uint32_t triangle, Cover cover) {
  worst.sheets += cover == Cover::Inside;
  const bool farther = std::abs(delta) > std::abs(worst.delta_m);
  if (!worst.covered() || farther) {
    worst.delta_m = delta;
    worst.triangle = triangle;
  }
}

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
Range lines_within(double low, double high, double step, int least, int most) {
  const double first = std::ceil(low / step - kNearLine),
               last = std::floor(high / step + kNearLine);
  return {static_cast<int>(std::clamp(first, static_cast<double>(least), most + 1.0)),
          static_cast<int>(std::clamp(last, least - 1.0, static_cast<double>(most)))};
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

void cover_samples(const Heightfield& field, const FlatTriangle& t, std::uint32_t index, Range rows,
                   int first_row, std::vector<Deviation>& found, float* triangle_max_m) {
  const Range own = lines_within(std::min({t.a.y, t.b.y, t.c.y}), std::max({t.a.y, t.b.y, t.c.y}),
                                 field.dy_m, rows.first, rows.last);
  double largest = 0.0;
  for (int j = own.first; j <= own.last; ++j) {
    const double y = j * field.dy_m;
    // The line is moved into the triangle where it misses it by a rounding.
    const double inside_y =
        std::clamp(y, std::min({t.a.y, t.b.y, t.c.y}), std::max({t.a.y, t.b.y, t.c.y}));
    Reach reach;
    reach.add(t.a, t.b, inside_y);
    reach.add(t.b, t.c, inside_y);
    reach.add(t.c, t.a, inside_y);
    const Range columns = lines_within(reach.low, reach.high, field.dx_m, 0, field.columns() - 1);
    for (int i = columns.first; i <= columns.last; ++i) {
      double z = 0.0;
      const Cover cover = t.cover(i * field.dx_m, y, z);
      if (cover == Cover::Outside) continue;
      auto& worst = found[static_cast<std::size_t>(j - first_row) * field.columns() +
                          static_cast<std::size_t>(i)];
      const double delta = z - field.heights_m(i, j);
      keep_worst(worst, delta, index, cover);
      largest = std::abs(delta) > largest ? std::abs(delta) : largest;
    }
  }
  if (triangle_max_m != nullptr) raise_to(*triangle_max_m, largest);
}

}  // namespace

void for_each_sample_row(const Heightfield& field, const TriangleMesh& mesh,
                         std::vector<float>* triangle_max_m,
                         const std::function<void(int, std::span<const Deviation>)>& visit) {
  const glm::dvec3 shift = mesh.origin_m - field.world_origin_m();
  if (triangle_max_m != nullptr) triangle_max_m->assign(mesh.triangles.size(), 0.0f);
  const int bands = (field.rows() + kBandRows - 1) / kBandRows;
  const RowBins bins(mesh, shift.y, kBandRows * field.dy_m, bands, kNearLine * field.dy_m);
  parallel_for(bands, 1, [&](std::int64_t band) {
    const int first = static_cast<int>(band) * kBandRows,
              last = std::min(first + kBandRows, field.rows()) - 1;
    std::vector<Deviation> found(static_cast<std::size_t>(last - first + 1) * field.columns());
    for (const std::uint32_t index : bins.triangles(static_cast<int>(band))) {
      const FlatTriangle t = flat_triangle(mesh, index, shift);
      if (!t.is_flat()) continue;
      cover_samples(field, t, index, {first, last}, first, found,
                    triangle_max_m ? &(*triangle_max_m)[index] : nullptr);
    }
    for (int j = first; j <= last; ++j) {
      const auto columns = static_cast<std::size_t>(field.columns());
      visit(j, {found.data() + static_cast<std::size_t>(j - first) * columns, columns});
    }
  });
}

namespace {

// Places in buckets of a coarse grid, row by row; those of a bucket by index.
struct Buckets {
  double width_m, height_m;
  int columns, rows;
  std::vector<std::uint32_t> start;   // of each bucket; one more at the end
  std::vector<std::uint32_t> places;  // indices

  Buckets(const Heightfield& field, const std::vector<glm::dvec3>& at) {
    // No more buckets than places need: a bucket is a power of two of cells.
    int cells = 1;
    while (static_cast<double>(field.cell_columns() / cells + 1) * (field.cell_rows() / cells + 1) >
           std::max(1024.0, 4.0 * static_cast<double>(at.size()))) {
      cells *= 2;
    }
    width_m = cells * field.dx_m;
    height_m = cells * field.dy_m;
    columns = field.cell_columns() / cells + 1;
    rows = field.cell_rows() / cells + 1;
    start.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + 1, 0);
    std::vector<std::uint32_t> bucket(at.size());
    for (std::size_t k = 0; k < at.size(); ++k) {
      bucket[k] = static_cast<std::uint32_t>(row_of(at[k].y) * columns + column_of(at[k].x));
      ++start[bucket[k] + 1];
    }
    for (std::size_t b = 1; b < start.size(); ++b) start[b] += start[b - 1];
    places.resize(at.size());
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (std::size_t k = 0; k < at.size(); ++k)
      places[next[bucket[k]]++] = static_cast<std::uint32_t>(k);
  }
  int column_of(double x) const { return clamped(x / width_m, columns); }
  int row_of(double y) const { return clamped(y / height_m, rows); }

 private:
  static int clamped(double at, int count) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, count - 1.0));
  }
};

}  // namespace

std::vector<Deviation> deviation_at(const Heightfield& field, const TriangleMesh& mesh,
                                    const std::vector<glm::dvec3>& places_m) {
  std::vector<Deviation> found(places_m.size());
  if (places_m.empty()) return found;
  const Buckets buckets(field, places_m);
  const glm::dvec3 shift = mesh.origin_m - field.world_origin_m();
  const double slack_x = kNearLine * field.dx_m, slack_y = kNearLine * field.dy_m;
  const RowBins bins(mesh, shift.y, buckets.height_m, buckets.rows, slack_y);
  parallel_for(buckets.rows, 1, [&](std::int64_t row) {
    const std::size_t row_start =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(buckets.columns);
    if (buckets.start[row_start] ==
        buckets.start[row_start + static_cast<std::size_t>(buckets.columns)])
      return;
    for (const std::uint32_t index : bins.triangles(static_cast<int>(row))) {
      const FlatTriangle t = flat_triangle(mesh, index, shift);
      if (!t.is_flat()) continue;
      const int first = buckets.column_of(std::min({t.a.x, t.b.x, t.c.x}) - slack_x);
      const int last = buckets.column_of(std::max({t.a.x, t.b.x, t.c.x}) + slack_x);
      // The places of neighbouring buckets of a row lie side by side.
      const std::uint32_t begin = buckets.start[row_start + static_cast<std::size_t>(first)];
      const std::uint32_t end = buckets.start[row_start + static_cast<std::size_t>(last) + 1];
      for (std::uint32_t k = begin; k < end; ++k) {
        const glm::dvec3& place = places_m[buckets.places[k]];
        double z = 0.0;
        const Cover cover = t.cover(place.x, place.y, z);
        if (cover != Cover::Outside)
          keep_worst(found[buckets.places[k]], z - place.z, index, cover);
      }
    }
  });
  return found;
}

}  // namespace plumb::audit
