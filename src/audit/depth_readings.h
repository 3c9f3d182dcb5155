// Every other way in which a depth buffer might have been meant. Not for users of the library.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audit/depth_meaning.h"
#include "core/camera.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// How plain an explanation is; plainer ones first.
enum class Plainness { OneMistake, TwoMistakes, Fitted, FittedTwice };

struct DepthReading {
  DepthMeaning meaning;
  Camera camera;   // whose pixels the numbers are
  Camera seen_by;  // that shows the truth as the frame was drawn: `camera`, unless the terrain
                   // itself was another; its vectors need not be orthonormal
  std::string text = "";  // "its rows run from the bottom up (--depth-y up)"
  Plainness plainness = Plainness::OneMistake;
  bool is_slight = false;  // a part of a pixel or of a sample: may be within the tolerance
};

/// All but the stated one, fitted ones apart.
std::vector<DepthReading> other_readings(const DepthReading& stated,
                                         const terrain::Heightfield& field);

/// A stored number and the view depth that the truth has there.
struct StoredDepth {
  double number, depth_m;
};

/// Window depth of near and far planes that explain the numbers best; nothing if none do. `reading`
/// says which way rows run; the text, what is not as `stated`. 1/w = a + b d is fitted by least
/// squares, each pixel's relative error counting the same, then again twice of the better half.
std::optional<DepthReading> reading_of_planes(const DepthReading& reading,
                                              const std::vector<StoredDepth>& stored,
                                              const DepthMeaning& stated);

/// What a unit of so many metres is called: "feet", or its size.
std::string unit_text(double metres_per_unit);

std::string convention_text(DepthConvention convention);

}  // namespace plumb::audit
