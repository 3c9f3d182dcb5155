#include "audit/offenders.h"

#include <algorithm>
#include <utility>

namespace plumb::audit {
namespace {

using WorstPixel = std::pair<float, std::size_t>;  // its error and its number

// The `most` largest errors above zero, worst first, the first of equals first.
std::vector<WorstPixel> worst_pixels(const std::vector<float>& errors, std::size_t most) {
  const auto is_worse = [](const WorstPixel& a, const WorstPixel& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  };
  std::vector<WorstPixel> worst;
  float least = 0.0f;
  for (std::size_t pixel = 0; pixel < errors.size(); ++pixel) {
    if (!(errors[pixel] > least)) continue;
    const WorstPixel here{errors[pixel], pixel};
    worst.insert(std::upper_bound(worst.begin(), worst.end(), here, is_worse), here);
    if (worst.size() > most) worst.pop_back();
    if (worst.size() == most) least = worst.back().first;
  }
  return worst;
}

}  // namespace

Offender OffenderFinder::at_place(std::string what, double value, Unit unit,
                                  const glm::dvec3& local_m, std::uint32_t triangle) const {
  Offender o{std::move(what), value, unit};
  o.world_m = truth_.field().world_origin_m() + local_m;
  if (triangle != kNoPrimitive) set_patch(o, patch_of(surface_, triangle));
  const glm::dvec3 view = to_view(camera_, o.world_m);
  if (view.z > 0.0) {
    const glm::dvec2 pixel = view_to_pixel(camera_, view);
    const bool inside = pixel.x >= 0.0 && pixel.x < camera_.width_px && pixel.y >= 0.0 &&
                        pixel.y < camera_.height_px;
    if (inside) {
      o.x = static_cast<int>(pixel.x);
      o.y = static_cast<int>(pixel.y);
    }
  }
  return o;
}

void OffenderFinder::set_patch(Offender& o, int patch) const {
  if (patch < 0 || patch >= static_cast<int>(surface_.patches.size())) return;
  o.patch = patch;
  o.patch_name = surface_.patches[static_cast<std::size_t>(patch)].name;
}

std::optional<Offender> OffenderFinder::at_sample(const std::string& what, const WorstSample& worst,
                                                  Unit unit) const {
  if (worst.i < 0) return std::nullopt;
  const terrain::Heightfield& field = truth_.field();
  Offender o =
      at_place(what, worst.error, unit,
               {worst.i * field.dx_m, worst.j * field.dy_m, field.heights_m(worst.i, worst.j)},
               worst.triangle);
  o.sample_i = worst.i;
  o.sample_j = worst.j;
  return o;
}

Offender OffenderFinder::at_pixel(std::string what, double value, Unit unit,
                                  std::size_t pixel) const {
  const HitImage& drawn = result_.drawn;
  const glm::dvec3 local =
      camera_.eye_m - truth_.field().world_origin_m() + drawn.from_eye_m[pixel];
  Offender o = at_place(std::move(what), value, unit, local, drawn.primitive[pixel]);
  o.x = static_cast<int>(pixel % static_cast<std::size_t>(drawn.width_px));
  o.y = static_cast<int>(pixel / static_cast<std::size_t>(drawn.width_px));
  return o;
}

Offender OffenderFinder::at_defect(const CoverageDefect& defect) const {
  Offender o{name_of(defect.kind), 1.0, Unit::Count, defect.x, defect.y};
  const std::size_t pixel = result_.drawn.index(defect.x, defect.y);
  const glm::dvec3 ray = defect.kind == DefectKind::Overshoot ? result_.drawn.from_eye_m[pixel]
                                                              : result_.true_hits.from_eye_m[pixel];
  o.world_m = camera_.eye_m + ray;
  set_patch(o, defect.patch_a);
  if (defect.patch_b >= 0 && defect.patch_b < static_cast<int>(surface_.patches.size())) {
    o.patch_name += " | " + surface_.patches[static_cast<std::size_t>(defect.patch_b)].name;
  }
  return o;
}

std::vector<Offender> OffenderFinder::worst(std::size_t most) const {
  std::vector<Offender> found;
  for (const CoverageDefect& defect : result_.coverage.listed) {
    if (found.size() >= most) break;
    found.push_back(at_defect(defect));
  }
  if (auto o = at_sample("sample-error", result_.samples.worst_px, Unit::Pixel))
    found.push_back(*std::move(o));
  if (auto o = at_sample("sample-error", result_.samples.worst_m, Unit::Metre))
    found.push_back(*std::move(o));
  for (const auto& [error, pixel] : worst_pixels(result_.pixels.vertical_px, most))
    found.push_back(at_pixel("pixel-error", error, Unit::Pixel, pixel));
  for (const TopologyFlaw& flaw : result_.topology.listed)
    found.push_back(at_place(flaw.kind, 1.0, Unit::Count, flaw.at_m, flaw.triangle));
  return found;
}

}  // namespace plumb::audit
