// How far what a node draws lies above or below the heights that the stacks stand for.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "mesh/stacks/errors.h"
#include "mesh/stacks/height_surface.h"
#include "mesh/stacks/stack_densities.h"

namespace plumb::mesh::stacks {

/// What is drawn over some heights for one camera.
struct HeightsReached {
  double px = 0.0;        // the largest error in view, a bound; +inf where the eye is as near
  int parts_over = 0;     // of nodes, in view, that miss the tolerance
  double metres = 0.0;    // the largest error of those, up or down
  double finest_m = 0.0;  // and of those of the finest level
};

/// What is drawn, measured straight up and down against a heightfield's own triangles, in parts of
/// a node: 4 x 4 x 4 voxels of it. The finest level's error is not zero.
///
/// One way is enough: what is drawn covers the plan, so that above or below every point of the
/// heights is a drawn one.
class HeightErrors final : public Errors {
 public:
  /// Keeps a reference to the densities.
  HeightErrors(const StackDensities& densities, std::shared_ptr<const HeightSurface> heights)
      : densities_(densities), heights_(std::move(heights)) {}

  const HeightSurface& heights() const { return *heights_; }

  Box reach(const Node& node) const override;
  double apart_px(const Camera& camera, const Box& box, double distance_m) const override;
  void make(std::span<const Node>) const override {}
  bool is_over_among_equals(const DrawnMesh& drawn, const std::function<NodeMeshes()>& around,
                            const Allowed& allowed) override;
  std::vector<Box> over(const DrawnMesh& drawn, const NodeMeshes& around,
                        const Allowed& allowed) override;

  /// camera  relative to (field().origin_m, 0)
  HeightsReached reached(std::span<const Node> nodes, const NodeMeshes& meshes,
                         const Camera& camera, double tolerance_px);

 private:
  struct Part {
    Box box;             // of what is drawn and of the heights above and below it
    double off_m = 0.0;  // up or down
  };
  using Parts = std::shared_ptr<const std::vector<Part>>;

  Parts parts(const DrawnMesh& drawn);
  std::vector<Part> measured(const DrawnMesh& drawn) const;

  const StackDensities& densities_;
  std::shared_ptr<const HeightSurface> heights_;
  std::mutex mutex_;  // of what follows, which is looked up and never walked
  std::map<const NodeMesh*, Parts> parts_;
};

}  // namespace plumb::mesh::stacks
