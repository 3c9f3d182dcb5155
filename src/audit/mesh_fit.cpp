#include "audit/mesh_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "audit/coarse_truth.h"
#include "audit/depth_readings.h"
#include "audit/mesh_placing.h"
#include "audit/mesh_shift.h"
#include "audit/plan_fit.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

constexpr std::size_t kMostVertices = 4096;  // looked at
constexpr std::size_t kFewVertices = 256;    // of them, to choose among placings
constexpr double kLeastArea = 0.01;          // of the terrain's
constexpr double kLeastOver = 0.9;           // of the vertices
constexpr double kLeastFactor = 0.01;        // of heights: a level plane explains nothing
constexpr double kLikeTerrain = 0.25;        // of what a level plane is off by
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Box box_of(const std::vector<glm::dvec3>& points) {
  Box box;
  for (const glm::dvec3& p : points) box.add(p);
  return box;
}

std::vector<glm::dvec3> some_of(const std::vector<glm::dvec3>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<glm::dvec3> some(most);
  for (std::size_t k = 0; k < most; ++k) some[k] = all[k * all.size() / most];
  return some;
}

struct Fit {
  double misfit = 1.0;
  bool is_likely = false;
};

// What was fitted is known to a millimetre, not to all its digits.
glm::dvec3 rounded(const glm::dvec3& offset, const glm::dvec3& fitted) {
  if (fitted == glm::dvec3(0.0)) return offset;
  const auto to_millimetres = [](double x) { return 1e-3 * std::round(1e3 * x) + 0.0; };
  return {to_millimetres(offset.x), to_millimetres(offset.y), to_millimetres(offset.z)};
}

class MeshFit {
 public:
  MeshFit(const HeightfieldTruth& truth, const TriangleMesh& mesh,
          const terrain::MeshReadOptions& options, const Camera& camera, const Tolerance& tolerance)
      : truth_(truth),
        options_(options),
        offset_(mesh.origin_m),
        origin_(truth.field().world_origin_m()),
        local_(relative_to(camera, origin_)),
        tolerance_(tolerance),
        file_box_(bounds(mesh)),
        vertices_(some_of(mesh.vertices_m, kMostVertices)),
        few_(some_of(vertices_, kFewVertices)) {
    const Box box = bounds(truth.field());
    extent_ = {truth.field().cell_columns() * truth.field().dx_m,
               truth.field().cell_rows() * truth.field().dy_m};
    relief_m_ = box.empty() ? 0.0 : box.high.z - box.low.z;
    if (!(relief_m_ > 0.0)) relief_m_ = std::max(extent_.x, extent_.y);
  }

  std::optional<Misfit> misfit() {
    const std::vector<glm::dvec3> points = placed(vertices_, {});
    const PlanFit stated = plan_fit(truth_, points);
    const bool most_is_within =
        2 * count_within(points) >= static_cast<std::int64_t>(points.size());
    // Wherever else it reaches, it is the terrain's where it stands over it.
    if (stated.over_terrain >= kFewestPoints && area_over(points) > 0.0 &&
        stated.off_m <= kLikeTerrain * stated.relief_m + truth_.slack_m) {
      if (!look_at_shift(stated.off_m, {})) return std::nullopt;
      return Misfit{text_of_fit(before_text(stated)), !most_is_within};
    }
    before_ = fit_of(points).misfit;
    if (before_ * relief_m_ <= truth_.slack_m) return std::nullopt;
    if (vertices_.size() >= static_cast<std::size_t>(kFewestPoints)) {
      look_at_placings();
      if (text_.empty()) look_at_heights(stated);
      if (text_.empty() && stated.over_terrain >= kFewestPoints) look_at_shift(stated.off_m, {});
    }
    if (!text_.empty()) {
      return Misfit{text_of_fit(before_text(stated)), !most_is_within};
    }
    if (most_is_within || is_of_terrain(points, stated)) return std::nullopt;
    return Misfit{
        fmt::format(
            "nothing that is known to go wrong explains the mesh, so it is of another "
            "terrain or place: {:.3g} % of its vertices stand over the terrain{}",
            100.0 * static_cast<double>(stated.over_terrain) / static_cast<double>(stated.points),
            before_text(stated)),
        true};
  }

 private:
  std::string text_of_fit(const std::string& before) const {
    return fmt::format(
        "the mesh fits if {}: its vertices then stand {:.3g} m off the terrain in the mean{}",
        text_, relief_m_ * best_, before);
  }

  // A place a little beside a placing that explains nearly all that it leaves.
  bool look_at_shift(double left_m, const Placing& placing) {
    const std::vector<glm::dvec3> points = placed(vertices_, placing);
    if (points.size() < static_cast<std::size_t>(kFewestPoints) || !(left_m > truth_.slack_m))
      return false;
    const MeshShift shift = shift_to_terrain(truth_, points);
    std::vector<glm::dvec3> moved = points;
    for (glm::dvec3& p : moved) p += shift.by_m;
    if (!(shift.off_m * kFarBetter <= left_m) || !fit_of(moved).is_likely) return false;
    best_ = shift.off_m / relief_m_;
    text_ = text_of(placing, shift.by_m);
    return true;
  }

  std::string before_text(const PlanFit& stated) const {
    if (stated.over_terrain == 0) return ", as stated beside it";
    return fmt::format(", as stated {:.3g} m (a level plane: {:.3g} m)", stated.off_m,
                       stated.relief_m);
  }

  glm::dvec3 offset_of(const Placing& placing) const {
    const glm::dvec3 a = placing.scale * placing.axes.turned(file_box_.low),
                     b = placing.scale * placing.axes.turned(file_box_.high);
    const glm::dvec2 low(std::min(a.x, b.x), std::min(a.y, b.y)),
        high(std::max(a.x, b.x), std::max(a.y, b.y));
    const glm::dvec2 before(file_box_.low), origin(origin_), given(offset_);
    glm::dvec2 offset = given;
    switch (placing.place) {
      case Place::AsGiven:
        break;
      case Place::InPlace:
        offset = given + before - low;
        break;
      case Place::OwnOrigin:
        offset = origin;
        break;
      case Place::NoOrigin:
        offset = glm::dvec2(0.0);
        break;
      case Place::Corner:
        offset = origin - low;
        break;
      case Place::Middle:
        offset = origin + 0.5 * extent_ - 0.5 * (low + high);
        break;
    }
    return {offset.x, offset.y, offset_.z};
  }

  // Relative to the terrain's origin.
  std::vector<glm::dvec3> placed(const std::vector<glm::dvec3>& vertices,
                                 const Placing& placing) const {
    const glm::dvec3 shift = offset_of(placing) - origin_;
    std::vector<glm::dvec3> points(vertices.size());
    std::transform(vertices.begin(), vertices.end(), points.begin(), [&](const glm::dvec3& v) {
      return placing.scale * placing.axes.turned(v) + shift;
    });
    return points;
  }

  Fit fit_of(const std::vector<glm::dvec3>& points) const {
    std::vector<double> height;
    double off = 0.0, all = 0.0;
    for (const glm::dvec3& p : points) {
      const double h = height_near(p);
      all += std::isnan(h) ? 1.0 : std::min(1.0, std::abs(p.z - h) / relief_m_);
      if (std::isnan(h)) continue;
      off += std::abs(p.z - h);
      height.push_back(h);
    }
    Fit fit;
    fit.misfit = all / static_cast<double>(points.size());
    const Box box = box_of(points);
    const double area = (box.high.x - box.low.x) * (box.high.y - box.low.y);
    const bool is_over =
        static_cast<double>(height.size()) >= kLeastOver * static_cast<double>(points.size()) &&
        area >= kLeastArea * extent_.x * extent_.y;
    if (!is_over) return fit;
    const double middle = middle_of(height);
    double level = 0.0;
    for (const double h : height) level += std::abs(h - middle);
    fit.is_likely =
        off <= kLikeTerrain * level + truth_.slack_m * static_cast<double>(height.size());
    return fit;
  }

  // Of the box of those over the terrain: a mesh beside it may share a side.
  double area_over(const std::vector<glm::dvec3>& points) const {
    Box box;
    for (const glm::dvec3& p : points) {
      if (!std::isnan(height_near(p))) box.add(p);
    }
    return box.empty() ? 0.0 : (box.high.x - box.low.x) * (box.high.y - box.low.y);
  }

  // The vertices of a rim may stand beside it by the rounding of a unit or of single precision.
  double height_near(const glm::dvec3& p) const {
    const double rim = 1e-6 * std::max(extent_.x, extent_.y);
    const double x = p.x >= -rim && p.x <= extent_.x + rim ? std::clamp(p.x, 0.0, extent_.x) : p.x,
                 y = p.y >= -rim && p.y <= extent_.y + rim ? std::clamp(p.y, 0.0, extent_.y) : p.y;
    return truth_.height_at(x, y);
  }

  void look_at_placings() {
    const double width = file_box_.high.x - file_box_.low.x;
    const std::vector<Placing> placings = other_placings(width > 0.0 ? extent_.x / width : 1.0);
    std::vector<Fit> fits(placings.size());
    parallel_for(static_cast<std::int64_t>(placings.size()), 16, [&](std::int64_t k) {
      const auto at = static_cast<std::size_t>(k);
      fits[at] = fit_of(placed(few_, placings[at]));
    });
    int changes = 0;
    Placing chosen;
    for (int wanted = 1; wanted <= 2; ++wanted) {
      for (std::size_t k = 0; k < placings.size(); ++k) {
        if (placings[k].changes() != wanted || !fits[k].is_likely ||
            fits[k].misfit * kFarBetter > before_)
          continue;
        const double needed = changes == wanted || changes == 0 ? best_ : best_ / kFarBetter;
        if (!(fits[k].misfit < needed)) continue;
        const Fit whole = fit_of(placed(vertices_, placings[k]));
        if (!whole.is_likely || !(whole.misfit < needed)) continue;
        best_ = whole.misfit;
        changes = wanted;
        text_ = text_of(placings[k]);
        chosen = placings[k];
      }
    }
    if (changes > 0) look_at_shift(relief_m_ * best_, chosen);
  }

  void look_at_heights(const PlanFit& stated) {
    if (stated.over_terrain < kFewestPoints || 10 * stated.over_terrain < 9 * stated.points) return;
    const bool by_constant = stated.spread_m * kFarBetter <= stated.off_m &&
                             stated.spread_m <= kFarBetter * stated.left_m + truth_.slack_m;
    const double left = by_constant ? stated.spread_m : stated.left_m;
    const bool is_level = !by_constant && std::abs(stated.factor) < kLeastFactor;
    if (is_level || !(left * kFarBetter <= stated.off_m)) return;
    best_ = left / relief_m_;
    text_ = by_constant
                ? fmt::format("its heights are {} by {:.6g} m",
                              stated.shift_m > 0.0 ? "lowered" : "raised", std::abs(stated.shift_m))
                : fmt::format(
                      "its heights are taken for the terrain's times {:.6g} plus "
                      "{:.6g} m",
                      stated.factor, stated.offset_m);
  }

  std::string text_of(const Placing& placing, const glm::dvec3& shift = glm::dvec3(0.0)) const {
    std::vector<std::string> parts;
    if (!(placing.axes == Axes{})) parts.push_back(axes_text(placing.axes, options_.up_axis));
    if (placing.scale != 1.0) {
      const double unit = placing.scale * options_.metres_per_unit;
      parts.push_back(fmt::format("its unit is {} (--scale {:.10g})", unit_text(unit), unit));
    }
    const glm::dvec3 offset = rounded(offset_of(placing) + shift, shift);
    if ((placing.place != Place::AsGiven || shift != glm::dvec3(0.0)) && offset != offset_)
      parts.push_back(
          fmt::format("its (0, 0, 0) lies at ({0:.10g}, {1:.10g}, {2:.10g}) m (--offset "
                      "{0:.10g},{1:.10g},{2:.10g})",
                      offset.x, offset.y, offset.z));
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ", and ") + part;
    return text;
  }

  std::int64_t count_within(const std::vector<glm::dvec3>& points) const {
    return std::count_if(points.begin(), points.end(), [&](const glm::dvec3& p) {
      return keeps_to(tolerance_, local_, p, height_near(p) - p.z);
    });
  }

  bool is_of_terrain(const std::vector<glm::dvec3>& points, const PlanFit& stated) const {
    if (points.size() < static_cast<std::size_t>(kFewestPoints)) return true;
    if (stated.over_terrain < kFewestPoints) return false;
    for (const auto& coarse : coarse_truths(truth_)) {
      double off = 0.0;
      for (const glm::dvec3& p : points) {
        const double h = truth_.height_at(p.x, p.y), level = coarse->truth.height_at(p.x, p.y);
        if (!std::isnan(h) && !std::isnan(level)) off += std::abs(level - h);
      }
      if (stated.off_m * static_cast<double>(stated.over_terrain) <= off) return true;
    }
    return false;
  }

  const HeightfieldTruth& truth_;
  terrain::MeshReadOptions options_;
  glm::dvec3 offset_, origin_;
  Camera local_;
  Tolerance tolerance_;
  Box file_box_;
  std::vector<glm::dvec3> vertices_, few_;
  glm::dvec2 extent_{0.0};
  double relief_m_ = 0.0;
  double before_ = 1.0, best_ = kInfinity;
  std::string text_;
};

}  // namespace

std::optional<Misfit> misfit_of_mesh(const HeightfieldTruth& truth, const TriangleMesh& mesh,
                                     const terrain::MeshReadOptions& options, const Camera& camera,
                                     const Tolerance& tolerance) {
  return MeshFit(truth, mesh, options, camera, tolerance).misfit();
}

}  // namespace plumb::audit
