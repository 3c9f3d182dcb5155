#include "audit/row_bins.h"

#include <algorithm>

namespace plumb::audit {

RowBins::RowBins(const TriangleMesh& mesh, double shift_y_m, double band_m, int bands,
                 double slack_m)
    : lists_(
          mesh.triangles.size(), static_cast<std::size_t>(bands),
          [&, bands_per_m = 1.0 / band_m](std::uint32_t triangle, const auto& visit) {
            // Truncation is the floor of what is not negative; `slack_m` covers the rounding of the
            // product.
            const auto band_of = [&](double y) {
              return static_cast<int>(std::clamp((y + shift_y_m) * bands_per_m, 0.0, bands - 1.0));
            };
            const Triangle& t = mesh.triangles[triangle];
            const double y0 = mesh.vertices_m[t[0]].y, y1 = mesh.vertices_m[t[1]].y,
                         y2 = mesh.vertices_m[t[2]].y;
            const int last = band_of(std::max({y0, y1, y2}) + slack_m);
            for (int band = band_of(std::min({y0, y1, y2}) - slack_m); band <= last; ++band)
              visit(band);
          },
          "the audit's index of triangles") {}

}  // namespace plumb::audit
