#include "openvdb_mesher.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <vector>

namespace plumb::bench {

struct OpenVdbMesher::Grid {
  openvdb::FloatGrid::Ptr values = openvdb::FloatGrid::create(0.0F);
};

OpenVdbMesher::OpenVdbMesher(const mesh::dual_contouring::Lattice<float>& density)
    : grid_(std::make_unique<Grid>()) {
  openvdb::initialize();
  const glm::ivec3 low = density.box().low, last = density.box().high() - 1;
  const openvdb::CoordBBox box({low.x, low.y, low.z}, {last.x, last.y, last.z});
  // Dense wants to be able to write.
  auto* values = const_cast<float*>(density.values().data());
  const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, values);
  openvdb::tools::copyFromDense(dense, *grid_->values, 0.0F);
}

OpenVdbMesher::~OpenVdbMesher() = default;

OpenVdbMesher::Size OpenVdbMesher::mesh() const {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid_->values, points, quads, 0.5);
  return {points.size(), quads.size()};
}

}  // namespace plumb::bench
