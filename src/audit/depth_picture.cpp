#include "audit/depth_picture.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include "audit/grid_crossings.h"
#include "audit/plan_fit.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Chooses a depth for each range.
class Settler {
 public:
  Settler(const HeightfieldTruth& truth, const Camera& camera, const Band& band)
      : truth_(truth), local_(relative_to(camera, truth.field().world_origin_m())), band_(band) {}

  double operator()(const DepthRange& range, double true_depth, const glm::dvec3& ray) const {
    if (range.low <= true_depth && true_depth <= range.high) return true_depth;
    if (range.is_sky()) return far_or_sky(range.low, true_depth, ray);
    const double nearest = true_depth < range.low ? range.low : range.high;
    if (range.low == range.high || keeps_to_band(nearest * ray)) return nearest;
    return least(range, nearest, ray);
  }

 private:
  // A number that stands for sky and for all that lies beyond `low`, the truth not among it: as
  // the truth is, if a surface that lies beyond may keep to the band, or else sky.
  double far_or_sky(double low, double true_depth, const glm::dvec3& ray) const {
    if (!(low < kNoHit) || !(true_depth < kNoHit)) return kNoHit;
    const terrain::Heightfield& field = truth_.field();
    const double across = std::sqrt(ray.x * ray.x + ray.y * ray.y);
    if (!(across > 0.0)) return kNoHit;
    const double extent = field.cell_columns() * field.dx_m + field.cell_rows() * field.dy_m;
    const double depth = least({low, low, low + extent / across}, low, ray);
    return keeps_to_band(depth * ray) ? true_depth : kNoHit;
  }

  double vertical_m(const glm::dvec3& from_eye) const {
    const glm::dvec3 point = local_.eye_m + from_eye;
    const double height = truth_.height_at(point.x, point.y);
    return std::isnan(height) ? kInfinity : height - point.z;
  }

  double vertical_px(const glm::dvec3& from_eye, double vertical) const {
    if (!std::isfinite(vertical)) return kInfinity;
    return screen_displacement_px(local_, local_.eye_m + from_eye, kUp, vertical);
  }

  bool keeps_to_band(const glm::dvec3& from_eye) const {
    const double vertical = vertical_m(from_eye);
    return std::abs(vertical) <= std::max(truth_.slack_m, band_.metres) ||
           vertical_px(from_eye, vertical) <= band_.pixels;
  }

  // See the header: ends, crossings of edges, changes of sign.
  double least(const DepthRange& range, double first, const glm::dvec3& ray) const {
    double best = first, vertical_before = vertical_m(range.low * ray);
    double least_px = vertical_px(first * ray, vertical_m(first * ray));
    double depth_before = range.low;
    bool is_found = false;  // the first beyond the truth that keeps to the band
    const auto settle_at = [&](double depth, double vertical, double error_px) {
      if (is_found || !(error_px < least_px)) return;
      least_px = error_px;
      best = depth;
      is_found =
          first == range.low && (error_px <= band_.pixels || std::abs(vertical) <= band_.metres);
    };
    const auto look_at = [&](double depth) {
      const double vertical = vertical_m(depth * ray);
      if (std::isfinite(vertical) && std::isfinite(vertical_before) &&
          vertical * vertical_before < 0.0) {
        const double share = vertical_before / (vertical_before - vertical);
        const double crossing = depth_before + share * (depth - depth_before);
        const double off = vertical_m(crossing * ray);
        settle_at(crossing, off, vertical_px(crossing * ray, off));
      }
      settle_at(depth, vertical, vertical_px(depth * ray, vertical));
      vertical_before = vertical;
      depth_before = depth;
    };
    look_at(range.low);
    const glm::dvec3 from = local_.eye_m + range.low * ray, to = local_.eye_m + range.high * ray;
    const double length = glm::dot(ray, ray);
    GridCrossings(truth_.field(), truth_.diagonal()).between(from, to, [&](const glm::dvec3& at) {
      look_at(std::clamp(glm::dot(at - local_.eye_m, ray) / length, range.low, range.high));
    });
    look_at(range.high);
    return best;
  }

  const HeightfieldTruth& truth_;
  Camera local_;
  Band band_;
};

void sum_up(DepthPicture& picture, const std::vector<double>& rounding_m, const Camera& camera) {
  std::vector<double> drawn;
  const glm::dvec3 up = direction_to_view(camera, kUp);
  for (std::size_t k = 0; k < rounding_m.size(); ++k) {
    if (!picture.image.hit(k) || !std::isfinite(rounding_m[k])) continue;
    drawn.push_back(rounding_m[k]);
    picture.largest_rounding_m = std::max(picture.largest_rounding_m, rounding_m[k]);
    const glm::dvec3& ray = picture.image.from_eye_m[k];
    const double depth = picture.image.depth_m[k];
    const glm::dvec3 view{glm::dot(ray, camera.right), glm::dot(ray, camera.up), depth};
    const double vertical = std::abs(ray.z) / depth * rounding_m[k];
    picture.largest_rounding_px = std::max(
        picture.largest_rounding_px, screen_displacement_of_view_px(camera, view, up, vertical));
  }
  picture.middle_rounding_m = middle_of(std::move(drawn));
}

}  // namespace

DepthPicture depth_picture(const HeightfieldTruth& truth, const HitImage& true_hits,
                           const image::DepthBuffer& buffer, const DepthMeaning& meaning,
                           const Camera& camera, const Band& band) {
  require(buffer.width_px == camera.width_px && buffer.height_px == camera.height_px &&
              true_hits.width_px == camera.width_px && true_hits.height_px == camera.height_px,
          "a depth buffer of {} x {} pixels, a truth of {} x {} and a camera of {} x {} must be of "
          "one size",
          buffer.width_px, buffer.height_px, true_hits.width_px, true_hits.height_px,
          camera.width_px, camera.height_px);
  DepthPicture picture;
  picture.image = HitImage(camera.width_px, camera.height_px);
  std::vector<double> rounding_m(picture.image.size(), 0.0);
  std::vector<std::uint8_t> is_none(picture.image.size(), 0), is_open(picture.image.size(), 0);
  const Settler settled(truth, camera, band);
  parallel_for(camera.height_px, 4, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < camera.width_px; ++x) {
      const std::size_t pixel = picture.image.index(x, y);
      const auto range = depth_range_at(buffer, meaning, camera, x, y);
      if (!range) {
        is_none[pixel] = 1;
        continue;
      }
      const glm::dvec3 ray = ray_direction(camera, x + 0.5, y + 0.5);
      const double depth = settled(*range, true_hits.depth_m[pixel], ray);
      is_open[pixel] = range->high == kInfinity && range->low < kInfinity && true_hits.hit(pixel) &&
                       true_hits.depth_m[pixel] >= range->low;
      rounding_m[pixel] = 0.5 * (range->high - range->low);
      if (!(depth < kNoHit)) continue;
      picture.image.depth_m[pixel] = depth;
      picture.image.from_eye_m[pixel] = depth * ray;
      picture.image.primitive[pixel] = 0;
    }
  });
  for (std::size_t pixel = 0; pixel < is_none.size(); ++pixel) {
    picture.undecided += is_open[pixel];
    if (!is_none[pixel] || picture.no_depths++ > 0) continue;
    picture.first_x = static_cast<int>(pixel % static_cast<std::size_t>(camera.width_px));
    picture.first_y = static_cast<int>(pixel / static_cast<std::size_t>(camera.width_px));
    picture.first_number =
        buffer.values[stored_index(buffer, meaning, picture.first_x, picture.first_y)];
  }
  sum_up(picture, rounding_m, camera);
  return picture;
}

DrawnSurface surface_of(HitImage picture) {
  DrawnSurface surface;
  surface.is_solid = false;
  surface.patches = {{0, 1, 0, "the depth buffer"}};
  const auto shared = std::make_shared<const HitImage>(std::move(picture));
  surface.painter = [shared](const Camera&) { return SurfacePicture{*shared}; };
  return surface;
}

std::string rounding_text(const DepthPicture& picture, const image::NumberFormat& format) {
  std::string text = fmt::format(
      "the depth buffer holds {}: a point may lie {:.3g} m of view depth to either side of where "
      "it "
      "stands, {:.3g} m in the middle (up to {:.3g} px on level ground); of that range the depth "
      "nearest to the truth is judged",
      image::to_text(format), picture.largest_rounding_m, picture.middle_rounding_m,
      picture.largest_rounding_px);
  if (picture.undecided > 0)
    text += fmt::format("; {} pixels, cleared or too far for it to tell, pass for terrain",
                        picture.undecided);
  return text;
}

}  // namespace plumb::audit
