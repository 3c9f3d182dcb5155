// The deviation at places that rays found: sorted into cells, so that each triangle asks few.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "audit/band_lists.h"
#include "audit/row_bins.h"
#include "audit/surface_deviation.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

using terrain::Heightfield;

// A coarse grid over the terrain; a bucket is a power of two of cells.
struct BucketGrid {
  double width_m, height_m;
  double columns_per_m, rows_per_m;
  int columns, rows;

  // No more buckets than `places` need.
  BucketGrid(const Heightfield& field, std::size_t places) {
    int cells = 1;
    while (static_cast<double>(field.cell_columns() / cells + 1) * (field.cell_rows() / cells + 1) >
           std::max(1024.0, 4.0 * static_cast<double>(places))) {
      cells *= 2;
    }
    width_m = cells * field.dx_m;
    height_m = cells * field.dy_m;
    columns_per_m = 1.0 / width_m;
    rows_per_m = 1.0 / height_m;
    columns = field.cell_columns() / cells + 1;
    rows = field.cell_rows() / cells + 1;
  }
  // Truncation is the floor of what is not negative; what lies outside belongs to the rim.
  int column_of(double x) const {
    return static_cast<int>(std::clamp(x * columns_per_m, 0.0, columns - 1.0));
  }
  int row_of(double y) const {
    return static_cast<int>(std::clamp(y * rows_per_m, 0.0, rows - 1.0));
  }
};

// The places of one row of buckets side by side, column by column.
class PlaceRow {
 public:
  PlaceRow(const BucketGrid& grid, std::span<const std::uint32_t> places,
           const std::vector<glm::dvec3>& at)
      : grid_(grid),
        start_(static_cast<std::size_t>(grid.columns) + 1, 0),
        place_(places.size()),
        at_(places.size()),
        found_(places.size()) {
    for (const std::uint32_t k : places) ++start_[column_of(at[k]) + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (const std::uint32_t k : places) {
      const std::uint32_t slot = next[column_of(at[k])]++;
      place_[slot] = k;
      at_[slot] = at[k];
    }
  }

  void add(const TriangleMesh& mesh, std::uint32_t index, const glm::dvec3& shift, double slack_m) {
    const Triangle& corners = mesh.triangles[index];
    const double x0 = mesh.vertices_m[corners[0]].x, x1 = mesh.vertices_m[corners[1]].x,
                 x2 = mesh.vertices_m[corners[2]].x;
    const int first = grid_.column_of(std::min({x0, x1, x2}) + shift.x - slack_m);
    const int last = grid_.column_of(std::max({x0, x1, x2}) + shift.x + slack_m);
    const std::uint32_t begin = start_[static_cast<std::size_t>(first)],
                        end = start_[static_cast<std::size_t>(last) + 1];
    if (begin == end) return;
    const FlatTriangle t = flat_triangle(mesh, index, shift);
    if (!t.is_flat()) return;
    for (std::uint32_t slot = begin; slot < end; ++slot) {
      const glm::dvec3& place = at_[slot];
      double z = 0.0;
      const Cover cover = t.cover(place.x, place.y, z);
      if (cover != Cover::Outside) found_[slot].add(z - place.z, index, cover);
    }
  }

  void give(std::vector<Deviation>& found) const {
    for (std::size_t slot = 0; slot < place_.size(); ++slot) found[place_[slot]] = found_[slot];
  }

 private:
  std::size_t column_of(const glm::dvec3& at) const {
    return static_cast<std::size_t>(grid_.column_of(at.x));
  }

  const BucketGrid& grid_;
  std::vector<std::uint32_t> start_;  // of each column; one more at the end
  std::vector<std::uint32_t> place_;
  std::vector<glm::dvec3> at_;
  std::vector<Deviation> found_;
};

}  // namespace

std::vector<Deviation> deviation_at(const Heightfield& field, const TriangleMesh& mesh,
                                    const std::vector<glm::dvec3>& places_m) {
  std::vector<Deviation> found(places_m.size());
  if (places_m.empty()) return found;
  const BucketGrid grid(field, places_m.size());
  const BandLists rows(
      places_m.size(), static_cast<std::size_t>(grid.rows),
      [&](std::uint32_t place, const auto& visit) { visit(grid.row_of(places_m[place].y)); },
      "the audit's index of places");
  const glm::dvec3 shift = mesh.origin_m - field.world_origin_m();
  const RowBins bins(mesh, shift.y, grid.height_m, grid.rows, kNearLine * field.dy_m);
  parallel_for(grid.rows, 1, [&](std::int64_t band) {
    const auto b = static_cast<std::size_t>(band);
    const std::span<const std::uint32_t> own = rows.of(b);
    if (own.empty()) return;
    PlaceRow row(grid, own, places_m);
    for (const std::uint32_t index : bins.triangles(static_cast<int>(band)))
      row.add(mesh, index, shift, kNearLine * field.dx_m);
    row.give(found);
  });
  return found;
}

}  // namespace plumb::audit
