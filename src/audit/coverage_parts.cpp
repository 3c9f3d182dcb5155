#include "audit/coverage_parts.h"

#include <array>
#include <cmath>
#include <map>

namespace plumb::audit {
namespace {

// The two patches that most pixels around show.
void name_patches(CoverageDefect& defect, const HitImage& drawn, const DrawnSurface& surface) {
  std::map<int, int> seen;
  for (int b = std::max(0, defect.y - 2); b <= std::min(drawn.height_px - 1, defect.y + 2); ++b) {
    for (int a = std::max(0, defect.x - 2); a <= std::min(drawn.width_px - 1, defect.x + 2); ++a) {
      const std::uint32_t primitive = drawn.primitive[drawn.index(a, b)];
      if (primitive != kNoPrimitive) ++seen[patch_of(surface, primitive)];
    }
  }
  std::array<int, 2> count{0, 0};
  for (const auto& [patch, pixels] : seen) {
    if (pixels > count[0]) {
      defect.patch_b = defect.patch_a;
      count[1] = count[0];
      defect.patch_a = patch;
      count[0] = pixels;
    } else if (pixels > count[1]) {
      defect.patch_b = patch;
      count[1] = pixels;
    }
  }
}

}  // namespace

const char* name_of(DefectKind kind) {
  switch (kind) {
    case DefectKind::None:
      return "none";
    case DefectKind::Hole:
      return "hole";
    case DefectKind::Overshoot:
      return "overshoot";
    case DefectKind::SeeThrough:
      return "see-through";
  }
  return "?";
}

int band_in_pixels(const Band& band) {
  return static_cast<int>(std::clamp(std::ceil(band.pixels), 1.0, static_cast<double>(kMostReach)));
}

void count_and_list(Coverage& coverage, const HitImage& true_hits, const HitImage& drawn,
                    const DrawnSurface& surface, int most_listed) {
  for (int y = 0; y < drawn.height_px; ++y) {
    for (int x = 0; x < drawn.width_px; ++x) {
      const std::size_t pixel = drawn.index(x, y);
      const Demand demand = coverage.demand[pixel];
      ++(demand == Demand::Terrain ? coverage.must_be_terrain
         : demand == Demand::Sky   ? coverage.must_be_sky
                                   : coverage.either);
      const DefectKind kind = coverage.defects[pixel];
      if (kind == DefectKind::None) continue;
      auto& count = kind == DefectKind::Hole        ? coverage.holes
                    : kind == DefectKind::Overshoot ? coverage.overshoots
                                                    : coverage.see_through;
      if (++count > most_listed) continue;
      CoverageDefect defect{kind, x, y, true_hits.depth_m[pixel], drawn.depth_m[pixel]};
      name_patches(defect, drawn, surface);
      coverage.listed.push_back(defect);
    }
  }
}

}  // namespace plumb::audit
