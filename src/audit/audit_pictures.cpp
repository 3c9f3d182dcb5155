#include "audit/audit_pictures.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "audit/surface_picture.h"
#include "core/parallel.h"
#include "image/srgb.h"
#include "raster/shading/shade.h"

namespace plumb::audit {
namespace {

image::Rgb8Image shaded(const HitImage& hits, const std::vector<glm::dvec3>& normals,
                        const TruthTerms& truth, const Camera& camera, bool two_sided = true,
                        std::span<const glm::vec3> albedo = {}) {
  raster::ShadeOptions options;
  options.albedo = albedo;
  options.two_sided = two_sided;
  const Box range = bounds(truth.field());
  if (!range.empty()) {
    options.low_m = range.low.z;
    options.high_m = range.high.z;
  }
  return image::to_srgb8(raster::shade(hits, camera, normals, options));
}

image::Rgb8Image blank(int width, int height) {
  image::Rgb8Image picture;
  picture.width_px = width;
  picture.height_px = height;
  picture.rgb.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  return picture;
}

}  // namespace

image::Rgb8Image rgb8_of(report::RgbImage picture) {
  return {picture.width, picture.height, std::move(picture.rgb)};
}

void paint(image::Rgb8Image& picture, int x, int y, report::Rgb colour) {
  if (x < 0 || y < 0 || x >= picture.width_px || y >= picture.height_px) return;
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * picture.width_px + static_cast<std::size_t>(x));
  picture.rgb[at] = colour.r;
  picture.rgb[at + 1] = colour.g;
  picture.rgb[at + 2] = colour.b;
}

image::Rgb8Image truth_picture(const AuditResult& result, const TruthTerms& terms,
                               const Camera& camera) {
  const HitImage& hits = result.true_hits;
  if (terms.mesh() != nullptr) {
    const DrawnSurface& surface = terms.mesh()->surface();
    return shaded(hits, raster::flat_normals(*surface.mesh, hits), terms, camera, true,
                  vertex_albedo(surface, hits, camera));
  }
  const HeightfieldTruth& truth = *terms.heights();
  std::vector<glm::dvec3> normals(hits.size(), glm::dvec3(0.0));
  parallel_for(static_cast<std::int64_t>(hits.size()), 4096, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (hits.hit(pixel))
      normals[pixel] =
          reference::triangle_normal(truth.field(), truth.diagonal(), hits.primitive[pixel]);
  });
  return shaded(hits, normals, terms, camera);
}

image::Rgb8Image drawn_picture(const AuditResult& result, const TruthTerms& truth,
                               const DrawnSurface& surface, const Camera& camera) {
  const terrain::Diagonal diagonal =
      truth.heights() != nullptr ? truth.heights()->diagonal() : terrain::Diagonal::Alternating;
  return shaded(result.drawn,
                shading_normals(surface, result.drawn, camera, truth.field(), diagonal), truth,
                camera, result.of_mesh, vertex_albedo(surface, result.drawn, camera));
}

image::Rgb8Image difference_picture(const image::Rgb8Image& a, const image::Rgb8Image& b) {
  image::Rgb8Image difference = blank(a.width_px, a.height_px);
  for (std::size_t k = 0; k < difference.rgb.size(); ++k) {
    difference.rgb[k] = static_cast<std::uint8_t>(std::min(255, 4 * std::abs(a.rgb[k] - b.rgb[k])));
  }
  return difference;
}

image::Rgb8Image coverage_picture(const AuditResult& result) {
  const Coverage& coverage = result.coverage;
  image::Rgb8Image picture = blank(result.drawn.width_px, result.drawn.height_px);
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const Demand demand = coverage.demand[result.drawn.index(x, y)];
      const std::uint8_t grey = demand == Demand::Terrain ? 60 : demand == Demand::Sky ? 225 : 150;
      paint(picture, x, y, {grey, grey, grey});
    }
  }
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const DefectKind kind = coverage.defects[result.drawn.index(x, y)];
      if (kind == DefectKind::None) continue;
      const report::Rgb colour = kind == DefectKind::Hole        ? report::Rgb{230, 30, 30}
                                 : kind == DefectKind::Overshoot ? report::Rgb{220, 40, 220}
                                                                 : report::Rgb{255, 150, 0};
      for (int b = -1; b <= 1; ++b) {
        for (int a = -1; a <= 1; ++a) paint(picture, x + a, y + b, colour);
      }
    }
  }
  return picture;
}

image::Rgb8Image triangles_picture(const AuditResult& result, const DrawnSurface& surface) {
  const HitImage& drawn = result.drawn;
  std::vector<double> levels(drawn.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t pixel = 0; pixel < drawn.size(); ++pixel) {
    if (!drawn.hit(pixel)) continue;
    // One more, so that the finest is no black on which its outlines drown.
    levels[pixel] =
        1.0 + (surface.triangle_lod.empty() ? 0.0 : surface.triangle_lod[drawn.primitive[pixel]]);
  }
  report::HeatMapOptions options;
  options.unit = "levels";
  image::Rgb8Image picture =
      rgb8_of(report::heat_picture(drawn.width_px, drawn.height_px, levels, options));
  constexpr report::Rgb kOutline{15, 15, 20};
  for (int y = 0; y < drawn.height_px; ++y) {
    for (int x = 0; x < drawn.width_px; ++x) {
      const std::uint32_t here = drawn.primitive[drawn.index(x, y)];
      const bool left = x > 0 && drawn.primitive[drawn.index(x - 1, y)] != here;
      const bool above = y > 0 && drawn.primitive[drawn.index(x, y - 1)] != here;
      if (here != kNoPrimitive && (left || above)) paint(picture, x, y, kOutline);
    }
  }
  return picture;
}

namespace {

// As people can tell them apart, those with weak red and green sight too (Okabe and Ito's).
struct Named {
  const char* name;
  report::Rgb colour;
};
constexpr Named kKindColours[DrawnSurface::kMostKinds] = {
    {"grey", {150, 150, 150}}, {"blue", {0, 114, 178}},     {"orange", {230, 159, 0}},
    {"green", {0, 158, 115}},  {"purple", {204, 121, 167}}, {"yellow", {240, 228, 66}}};

report::Rgb darker(report::Rgb c) {
  return {static_cast<std::uint8_t>(c.r / 2), static_cast<std::uint8_t>(c.g / 2),
          static_cast<std::uint8_t>(c.b / 2)};
}

}  // namespace

image::Rgb8Image kinds_picture(const AuditResult& result, const DrawnSurface& surface) {
  const HitImage& drawn = result.drawn;
  image::Rgb8Image picture = blank(drawn.width_px, drawn.height_px);
  const auto patch_at = [&](int x, int y) {
    const std::uint32_t primitive = drawn.primitive[drawn.index(x, y)];
    return primitive == kNoPrimitive ? -1 : patch_of(surface, primitive);
  };
  for (int y = 0; y < drawn.height_px; ++y) {
    for (int x = 0; x < drawn.width_px; ++x) {
      const int patch = patch_at(x, y);
      if (patch < 0) {
        paint(picture, x, y, {235, 235, 235});
        continue;
      }
      const report::Rgb colour =
          kKindColours[surface.patches[static_cast<std::size_t>(patch)].kind].colour;
      const bool outline =
          (x > 0 && patch_at(x - 1, y) != patch) || (y > 0 && patch_at(x, y - 1) != patch);
      paint(picture, x, y, outline ? darker(colour) : colour);
    }
  }
  return picture;
}

std::string kinds_legend(const DrawnSurface& surface) {
  std::string text;
  for (std::size_t k = 0; k < surface.kinds.size(); ++k)
    text += (k > 0 ? "; " : "") + surface.kinds[k] + " " + kKindColours[k].name;
  return "Boxes outlined. Colours: " + text + ".";
}

image::Rgb8Image side_by_side(const std::vector<image::Rgb8Image>& pictures) {
  constexpr int kGap = 8;
  int width = 0, height = 0;
  for (const image::Rgb8Image& picture : pictures) {
    width += picture.width_px + (width > 0 ? kGap : 0);
    height = std::max(height, picture.height_px);
  }
  image::Rgb8Image joined = blank(width, height);
  std::fill(joined.rgb.begin(), joined.rgb.end(), std::uint8_t{255});
  int left = 0;
  for (const image::Rgb8Image& picture : pictures) {
    for (int y = 0; y < picture.height_px; ++y) {
      const auto row = picture.rgb.begin() + static_cast<std::ptrdiff_t>(3) * y * picture.width_px;
      std::copy(row, row + static_cast<std::ptrdiff_t>(3) * picture.width_px,
                joined.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * width + left));
    }
    left += picture.width_px + kGap;
  }
  return joined;
}

ErrorMap error_map(const AuditResult& result, const std::vector<float>& errors_px,
                   const std::string& title, double limit_px, const std::string& unit) {
  const std::vector<double> values(errors_px.begin(), errors_px.end());
  report::HeatMapOptions options;
  options.title = title;
  options.unit = unit;
  if (limit_px > 0.0) options.limit = limit_px;
  const int width = result.drawn.width_px, height = result.drawn.height_px;
  report::HeatMapOptions of_page = options;
  of_page.text_scale = report::kPageLegendTextScale;
  return {rgb8_of(report::heat_picture(width, height, values, options)),
          rgb8_of(report::heat_legend(report::kPageLegendWidthPx, values, of_page)),
          rgb8_of(report::heat_map(width, height, values, options))};
}

}  // namespace plumb::audit
