// OpenVDB's dual contouring, beside which ours is measured.
#pragma once

#include <cstddef>
#include <memory>

#include "mesh/dual_contouring/lattice.h"

namespace plumb::bench {

/// A lattice as OpenVDB's grid; beyond it is air.
class OpenVdbMesher {
 public:
  explicit OpenVdbMesher(const mesh::dual_contouring::Lattice<float>& density);
  ~OpenVdbMesher();

  struct Size {
    std::size_t vertices = 0, quads = 0;
  };
  /// tools::volumeToMesh where the density is 1/2, with adaptivity 0.
  Size mesh() const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace plumb::bench
