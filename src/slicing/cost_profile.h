// How fast a machine is, for the cost model.
#pragma once

#include <string>

namespace plumb::slicing {

/// A profile is part of a picture: another one chooses other slices.
struct CostProfile {
  std::string name = "geforce2-mx";
  double vertices_per_s = 9.5e6;  // > 0
  double pixels_per_s = 157e6;    // > 0, rasterised with a look at the height
};

}  // namespace plumb::slicing
