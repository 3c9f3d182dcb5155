// The pictures of a comparison's report.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/picture_pair.h"
#include "image/colour_image.h"

namespace plumb::compare {

/// A picture: in the folder as a file (with its legend below it), in the page with note and legend.
struct ReportPicture {
  std::string file;  // "flip.png": of small letters, digits and hyphens; no two alike
  std::string name, note;
  image::Rgb8Image picture;
  image::Rgb8Image legend = {};
};

/// Whether a map's numbers are names and no sizes: the coverage map, which has a picture of its
/// own.
bool is_kind_map(const ErrorMap& map);

/// Reference, candidate, difference, a heat map of each ErrorMap of sizes (its scale ends at its
/// limit, with what is above it in a colour of its own), coverage and mask where they are there.
/// Throws std::invalid_argument if a map has not a value for each pixel.
std::vector<ReportPicture> comparison_pictures(const PicturePair& pair,
                                               const Comparison& comparison);

/// What the reference leaves no choice about in greys (terrain dark, sky light), holes red,
/// overshoot magenta, each three pixels wide.
image::Rgb8Image coverage_picture(const PicturePair& pair, const CoverageErrors& errors);

/// The candidate, striped where the mask does not judge.
image::Rgb8Image mask_picture(const PicturePair& pair, const image::Rgb8Image& candidate);

/// Picture and legend, one above the other on white.
image::Rgb8Image stacked(const image::Rgb8Image& above, const image::Rgb8Image& below);

/// Candidate and worst map side by side, at most 256 x 192 pixels, as a PNG file's bytes. A pixel
/// of the small map is the worst of those that it stands for: no crack is averaged away.
std::vector<std::uint8_t> thumbnail_png(const PicturePair& pair, const Comparison& comparison);

}  // namespace plumb::compare
