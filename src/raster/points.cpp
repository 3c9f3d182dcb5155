#include "raster/points.h"

#include "core/parallel.h"
#include "raster/perspective.h"

namespace plumb::raster {
namespace {

// The triangle that a pixel shows; its neighbours often show the same.
class ShownTriangle {
 public:
  explicit ShownTriangle(const Geometry& geometry) : geometry_(geometry) {}

  /// Returns whether no corner of it is cut off.
  bool set(std::uint32_t triangle) {
    if (triangle == triangle_) return whole_;
    triangle_ = triangle;
    const Triangle& index = geometry_.mesh->triangles[triangle];
    const std::array<ScreenVertex, 3> corners{
        geometry_.vertices[index[0]], geometry_.vertices[index[1]], geometry_.vertices[index[2]]};
    whole_ = corners[0].x != kClipped && corners[1].x != kClipped && corners[2].x != kClipped;
    if (!whole_) return false;
    edges_ = edge_functions(corners);
    scales_ = corner_scales(edges_, corners);
    return true;
  }

  glm::dvec3 point(int x, int y, double depth_m) const {
    return triangle_point(geometry_, triangle_, corner_shares(edges_, scales_, x, y) * depth_m);
  }

 private:
  const Geometry& geometry_;
  std::uint32_t triangle_ = kNoPrimitive;
  bool whole_ = false;
  EdgeFunctions edges_{};
  glm::dvec3 scales_{0.0};
};

}  // namespace

void fill_points(const Geometry& geometry, HitImage& image) {
  parallel_for(image.height_px, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    ShownTriangle shown(geometry);
    for (int x = 0; x < image.width_px; ++x) {
      const std::size_t pixel = image.index(x, y);
      if (!image.hit(pixel) || !shown.set(image.primitive[pixel])) continue;
      image.from_eye_m[pixel] = shown.point(x, y, image.depth_m[pixel]);
    }
  });
}

}  // namespace plumb::raster
