// Two pictures as a screen shows them: colours, or a channel as a heat map where there are none.
#pragma once

#include <string>

#include "compare/picture_pair.h"
#include "image/colour_image.h"

namespace plumb::compare {

struct DisplayPair {
  image::Rgb8Image reference, candidate;
  std::string note;         // how they are shown, one sentence
  image::Rgb8Image legend;  // of the scale that both share; empty for colours
};

/// Colours of pictures that have them, linear light encoded as sRGB and clamped; else depth as a
/// heat map, both on one scale; else the first channel as greys between the extremes of both.
/// Throws std::invalid_argument if the pictures have no channel or are not alike.
DisplayPair display_pair(const PicturePair& pair);

struct DifferencePicture {
  image::Rgb8Image picture;
  double gain = 1.0;  // a power of two; what it makes larger than a whole is clamped
  std::string note;
};

/// Candidate minus reference around a middle grey, channel by channel as shown above. Where the
/// mask does not judge the picture is black; the gain makes the largest judged difference visible.
DifferencePicture difference_picture(const PicturePair& pair);

}  // namespace plumb::compare
