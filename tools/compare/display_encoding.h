// sRGB's curve for whole pictures of floats, fast, with the same bits on every machine.
#pragma once

#include <vector>

namespace plumb::compare {

/// The sRGB number of linear light; above one its curve goes on, zero and below is zero. Between
/// 2^-9 and 2^8 by straight lines between 1024 places an octave: within 1e-7 of linear_to_srgb,
/// relative. Never falls when `linear` rises.
class DisplayEncoding {
 public:
  DisplayEncoding();
  float operator()(float linear) const;

 private:
  std::vector<float> at_;  // of each place
};

}  // namespace plumb::compare
