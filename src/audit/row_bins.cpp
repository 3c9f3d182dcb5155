#include "audit/row_bins.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/memory.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

struct Bands {
  int first, last;
};

}  // namespace

RowBins::RowBins(const TriangleMesh& mesh, double shift_y_m, double band_m, int bands,
                 double slack_m) {
  // Truncation is the floor of what is not negative; `slack_m` covers the rounding of the product.
  const double bands_per_m = 1.0 / band_m;
  const auto band_of = [&](double y) {
    return static_cast<int>(std::clamp((y + shift_y_m) * bands_per_m, 0.0, bands - 1.0));
  };
  const auto bands_of = [&](std::uint32_t triangle) {
    const Triangle& t = mesh.triangles[triangle];
    const double y0 = mesh.vertices_m[t[0]].y, y1 = mesh.vertices_m[t[1]].y,
                 y2 = mesh.vertices_m[t[2]].y;
    return Bands{band_of(std::min({y0, y1, y2}) - slack_m),
                 band_of(std::max({y0, y1, y2}) + slack_m)};
  };
  // Pieces of the triangles count for themselves, then each knows where in a band its own begin.
  constexpr std::int64_t kPiece = 1 << 16;
  const auto count = static_cast<std::int64_t>(mesh.triangles.size());
  const std::int64_t pieces = (count + kPiece - 1) / kPiece;
  std::vector<std::vector<std::size_t>> counts(static_cast<std::size_t>(pieces));
  const auto for_piece = [&](std::int64_t piece, const auto& visit) {
    for (std::int64_t t = piece * kPiece; t < std::min((piece + 1) * kPiece, count); ++t) {
      const Bands touched = bands_of(static_cast<std::uint32_t>(t));
      for (int band = touched.first; band <= touched.last; ++band)
        visit(static_cast<std::size_t>(band), static_cast<std::uint32_t>(t));
    }
  };
  parallel_for(pieces, 1, [&](std::int64_t piece) {
    auto& own = counts[static_cast<std::size_t>(piece)];
    own.assign(static_cast<std::size_t>(bands), 0);
    for_piece(piece, [&](std::size_t band, std::uint32_t) { ++own[band]; });
  });
  start_.assign(static_cast<std::size_t>(bands) + 1, 0);
  std::size_t next = 0;
  for (std::size_t band = 0; band < static_cast<std::size_t>(bands); ++band) {
    start_[band] = next;
    for (auto& own : counts) next += std::exchange(own[band], next);
  }
  start_.back() = next;
  require_memory(static_cast<std::int64_t>(next * sizeof(std::uint32_t)),
                 "the audit's index of triangles");
  triangles_.resize(next);
  parallel_for(pieces, 1, [&](std::int64_t piece) {
    auto& own = counts[static_cast<std::size_t>(piece)];
    for_piece(piece, [&](std::size_t band, std::uint32_t t) { triangles_[own[band]++] = t; });
  });
}

}  // namespace plumb::audit
