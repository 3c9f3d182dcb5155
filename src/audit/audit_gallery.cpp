#include "audit/audit_gallery.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "audit/audit_pictures.h"
#include "audit/cost_maps.h"
#include "core/parallel.h"
#include "image/image_files.h"

namespace plumb::audit {
namespace {

// The bound that a map of pixel errors is coloured by: the method's claim, or else the user's
// limit.
double pixel_bound(const AuditResult& result) {
  for (const ClaimResult& c : result.claims) {
    const Measure measure = result.of_heights ? Measure::PixelError : Measure::NearestError;
    if (c.claim.unit == Unit::Pixel && c.label == name_of(measure)) return c.claim.bound;
  }
  return 0.0;
}

Shown shown_map(const std::string& file, const std::string& name, ErrorMap map,
                const std::string& title) {
  return {
      file, name, title + ".", std::move(map.picture), std::move(map.legend), std::move(map.both)};
}

// Where the work of drawing lies.
void add_cost_maps(std::vector<Shown>& shown, const AuditResult& result,
                   const AuditSubject& subject, const DrawnSurface& surface) {
  const auto add = [&](const char* file, const char* name, const std::vector<float>& values,
                       const std::string& title, const char* unit) {
    if (!values.empty())
      shown.push_back(shown_map(file, name, error_map(result, values, title, 0.0, unit), title));
  };
  const std::vector<std::uint16_t>& overdraw = result.drawn.overdraw;
  add("overdraw.png", "overdraw", {overdraw.begin(), overdraw.end()},
      "Fragments tested for each pixel", "fragments");
  if (result.of_mesh)
    add("triangle-density.png", "triangles a pixel",
        triangles_a_pixel(surface, result.drawn, subject.camera), "Triangles a pixel",
        "triangles a pixel");
}

std::vector<std::uint8_t> png_of(const image::Rgb8Image& picture) {
  if (picture.rgb.empty()) return {};
  const std::string bytes = image::png_bytes(picture);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<Shown> gallery(const AuditResult& result, const AuditSubject& subject,
                           const DrawnSurface& surface, const TruthTerms& truth) {
  const image::Rgb8Image true_picture = truth_picture(result, truth, subject.camera);
  const image::Rgb8Image drawn = drawn_picture(result, truth, surface, subject.camera);
  const double bound = pixel_bound(result);
  const std::string vertical = "Distance on screen to the truth above or below",
                    nearest = "Distance on screen to the nearest point of the truth",
                    reverse = "Distance on screen from the truth to the nearest point drawn";
  std::vector<Shown> shown;
  shown.push_back({"truth.png", "truth", "Rays against the full-detail surface.", true_picture});
  shown.push_back({"drawn.png", "drawn", "What the method draws.", drawn});
  shown.push_back({"difference.png", "difference", "Colours apart, four times as strong.",
                   difference_picture(true_picture, drawn)});
  std::vector<Shown> maps;
  std::vector<image::Rgb8Image> summary{true_picture, drawn};
  const auto add_map = [&](const char* file, const char* name, const std::vector<float>& errors,
                           const std::string& title) {
    if (errors.empty()) return;
    ErrorMap map = error_map(result, errors, title, bound);
    if (summary.size() == 2) summary.push_back(map.picture);
    maps.push_back(shown_map(file, name, std::move(map), title + ", in pixels"));
  };
  add_map("pixel-error.png", "pixel error", result.pixels.vertical_px, vertical);
  add_map("nearest-error.png", "nearest", result.nearest.forward_px, nearest);
  if (!result.of_heights)
    add_map("reverse-error.png", "from the truth", result.nearest.reverse_px, reverse);
  shown.push_back({"summary.png", "", "", side_by_side(summary)});
  std::move(maps.begin(), maps.end(), std::back_inserter(shown));
  if (!surface.kinds.empty())
    shown.push_back({"boxes.png", "boxes", kinds_legend(surface), kinds_picture(result, surface)});
  add_cost_maps(shown, result, subject, surface);
  shown.push_back({result.of_mesh ? "triangles.png" : "levels.png",
                   result.of_mesh ? "triangles" : "levels",
                   result.of_mesh ? "Each triangle outlined; the lighter, the coarser its level."
                                  : "Each patch outlined; the lighter, the coarser its level.",
                   triangles_picture(result, surface)});
  shown.push_back({"coverage.png", "coverage",
                   "Dark: must be terrain; light: must be sky; between: either. Red: hole; "
                   "magenta: overshoot; orange: see-through.",
                   coverage_picture(result)});
  return shown;
}

// Writes the pictures into the folder and gives those of the page; compressing them is most of a
// report's time.
report::Viewer write_gallery(const std::filesystem::path& folder, const std::vector<Shown>& gallery,
                             const AuditResult& result) {
  std::vector<report::ViewerImage> images(gallery.size());
  parallel_for(static_cast<std::int64_t>(gallery.size()), 1, [&](std::int64_t k) {
    const Shown& shown = gallery[static_cast<std::size_t>(k)];
    image::write_png(folder / shown.file,
                     shown.in_folder.rgb.empty() ? shown.picture : shown.in_folder);
    if (shown.name.empty()) return;
    images[static_cast<std::size_t>(k)] = {shown.name, shown.note, png_of(shown.picture),
                                           png_of(shown.legend)};
  });
  std::erase_if(images, [](const report::ViewerImage& picture) { return picture.name.empty(); });
  return {"pictures", "Truth, picture and error", result.drawn.width_px, result.drawn.height_px,
          std::move(images)};
}

}  // namespace plumb::audit
