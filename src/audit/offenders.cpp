#include "audit/offenders.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "audit/flat_triangle.h"

namespace plumb::audit {
namespace {

using WorstPixel = std::pair<float, std::size_t>;  // its error and its number

// The `most` largest errors above `least`, worst first, the first of equals first.
std::vector<WorstPixel> worst_pixels(std::span<const float> errors, std::size_t most, float least) {
  const auto is_worse = [](const WorstPixel& a, const WorstPixel& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  };
  std::vector<WorstPixel> worst;
  for (std::size_t pixel = 0; pixel < errors.size(); ++pixel) {
    if (!(errors[pixel] > least)) continue;
    const WorstPixel here{errors[pixel], pixel};
    worst.insert(std::upper_bound(worst.begin(), worst.end(), here, is_worse), here);
    if (worst.size() > most) worst.pop_back();
    if (worst.size() == most) least = worst.back().first;
  }
  return worst;
}

glm::ivec2 pixel_of(std::size_t index, const HitImage& image) {
  const auto width = static_cast<std::size_t>(image.width_px);
  return {static_cast<int>(index % width), static_cast<int>(index / width)};
}

}  // namespace

Offender OffenderFinder::at_place(std::string what, double value, Unit unit,
                                  const glm::dvec3& local_m, std::uint32_t triangle) const {
  Offender o{std::move(what), value, unit};
  o.world_m = truth_.field().world_origin_m() + local_m;
  if (triangle != kNoPrimitive) set_patch(o, patch_of(surface_, triangle));
  if (result_.of_mesh) o.triangle = triangle;
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

Offender OffenderFinder::at_hit(std::string what, double value, Unit unit, const HitImage& hits,
                                std::uint32_t triangle, std::size_t pixel) const {
  const glm::dvec3 local = camera_.eye_m - truth_.field().world_origin_m() + hits.from_eye_m[pixel];
  Offender o = at_place(std::move(what), value, unit, local, triangle);
  const glm::ivec2 seen_at = pixel_of(pixel, hits);
  o.x = seen_at.x;
  o.y = seen_at.y;
  return o;
}

Offender OffenderFinder::at_pixel(std::string what, double value, Unit unit,
                                  std::size_t pixel) const {
  const HitImage& drawn = result_.drawn;
  return at_hit(std::move(what), value, unit, drawn, drawn.primitive[pixel], pixel);
}

Offender OffenderFinder::at_true_pixel(std::string what, double value, Unit unit,
                                       std::size_t pixel) const {
  const std::uint32_t drawn_triangle = result_.of_heights ? result_.reverse_pixels.triangle[pixel]
                                                          : result_.nearest.reverse_triangle[pixel];
  return at_hit(std::move(what), value, unit, result_.true_hits, drawn_triangle, pixel);
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

std::vector<Offender> OffenderFinder::defects(std::size_t most) const {
  std::vector<Offender> found;
  for (const CoverageDefect& defect : result_.coverage.listed) {
    if (found.size() >= most) break;
    found.push_back(at_defect(defect));
  }
  return found;
}

std::vector<Offender> OffenderFinder::pixels(const std::string& what, std::span<const float> errors,
                                             Unit unit, std::size_t most, bool of_truth,
                                             double above) const {
  std::vector<Offender> found;
  for (const auto& [error, pixel] : worst_pixels(errors, most, static_cast<float>(above)))
    found.push_back(of_truth ? at_true_pixel(what, error, unit, pixel)
                             : at_pixel(what, error, unit, pixel));
  return found;
}

std::vector<Offender> OffenderFinder::topology_flaws() const {
  std::vector<Offender> found;
  for (const TopologyFlaw& flaw : result_.topology.listed)
    found.push_back(at_place(flaw.kind, 1.0, Unit::Count, flaw.at_m, flaw.triangle));
  return found;
}

// Where the terrain has no height, that of what is drawn there.
double OffenderFinder::height_over(const SampleFlaw& flaw) const {
  const terrain::Heightfield& field = truth_.field();
  double height = field.heights_m(flaw.i, flaw.j);
  if (std::isnan(height) && flaw.triangle != kNoPrimitive) {
    const glm::dvec3 shift = surface_.mesh->origin_m - field.world_origin_m();
    flat_triangle(*surface_.mesh, flaw.triangle, shift)
        .cover(flaw.i * field.dx_m, flaw.j * field.dy_m, height);
  }
  return height;
}

std::vector<Offender> OffenderFinder::sample_flaws(SampleFlaw::Kind kind) const {
  const terrain::Heightfield& field = truth_.field();
  std::vector<Offender> found;
  for (const SampleFlaw& flaw : result_.samples.listed) {
    if (flaw.kind != kind) continue;
    found.push_back(at_place(name_of(kind), 1.0, Unit::Count,
                             {flaw.i * field.dx_m, flaw.j * field.dy_m, height_over(flaw)},
                             flaw.triangle));
    found.back().sample_i = flaw.i;
    found.back().sample_j = flaw.j;
  }
  return found;
}

std::vector<Offender> OffenderFinder::worst(const std::vector<ClaimResult>& claims,
                                            std::size_t most) const {
  std::vector<Offender> found;
  std::set<std::pair<std::string, Unit>> told;
  const auto add = [&](std::vector<Offender> places) {
    std::move(places.begin(), places.end(), std::back_inserter(found));
  };
  const auto add_broken = [&](const ClaimResult& claim) {
    if (!claim.is_broken()) return;
    // A claim and a limit of one measure are broken at the same places; patches each have theirs.
    const bool is_new = told.emplace(claim.label, claim.claim.unit).second;
    if (!is_new && claim.claim.scope == Scope::Frame) return;
    add(claim.places);
  };
  const std::string coverage = name_of(Measure::Coverage);
  for (const ClaimResult& claim : claims) {
    if (claim.label == coverage) add_broken(claim);
  }
  for (const ClaimResult& claim : claims) {
    if (claim.label != coverage) add_broken(claim);
  }
  const auto is_told = [&](const char* label, Unit unit) { return told.count({label, unit}) > 0; };
  const auto add_sample = [&](const WorstSample& worst, Unit unit, double pixels_per_metre) {
    if (worst.error > truth_.slack_m() * pixels_per_metre && !is_told("sample-error", unit))
      add({*at_sample("sample-error", worst, unit)});
  };
  if (!is_told("coverage", Unit::Count)) add(defects(most));
  add_sample(result_.samples.worst_px, Unit::Pixel, result_.samples.pixels_per_metre);
  add_sample(result_.samples.worst_m, Unit::Metre, 1.0);
  if (!is_told("pixel-error", Unit::Pixel))
    add(pixels("pixel-error", result_.pixels.vertical_px, Unit::Pixel, most, false,
               truth_.slack_m() * result_.pixels.pixels_per_metre));
  if (!result_.of_heights && !is_told("nearest-error", Unit::Pixel)) {
    add(pixels("nearest-error", result_.nearest.forward_px, Unit::Pixel, most));
    add(pixels("nearest-error", result_.nearest.reverse_px, Unit::Pixel, most, true));
  }
  if (!is_told("topology", Unit::Count)) add(topology_flaws());
  if (!is_told("uncovered-samples", Unit::Count)) add(sample_flaws(SampleFlaw::Kind::Uncovered));
  add(sample_flaws(SampleFlaw::Kind::OverVoid));
  add(sample_flaws(SampleFlaw::Kind::Overlapped));
  return found;
}

}  // namespace plumb::audit
