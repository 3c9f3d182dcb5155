// A generated terrain seen by a camera, drawn as it is and as renderers get it wrong.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "image/plane_image.h"

namespace plumb::compare {

struct PlantedSceneOptions {
  std::string terrain = "alpine";  // a generator
  std::string view = "oblique";    // a preset
  std::uint64_t seed = 1;
  int samples = 513;  // along a side
  int width_px = 640, height_px = 360;
  int rays_px = 4;  // 1 or 4 a pixel, of the colours; all else is of the ray through the middle
};

/// Keeps the terrain. Pictures have all channels of rays through the full-detail surface (linear
/// colours) and a header. Same bits on any machine and number of threads.
class PlantedScene {
 public:
  explicit PlantedScene(const PlantedSceneOptions& options);
  ~PlantedScene();
  PlantedScene(const PlantedScene&) = delete;
  PlantedScene& operator=(const PlantedScene&) = delete;

  image::PlaneImage drawn() const;
  /// Through a camera whose image plane is moved by (x, y) pixels.
  image::PlaneImage shifted(double x_px, double y_px) const;
  /// Of every `stride`-th sample alone, straight lines between them.
  image::PlaneImage with_level_of_detail(int stride) const;
  /// With normals whose north component has the wrong sign.
  image::PlaneImage with_wrong_normals() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace plumb::compare
