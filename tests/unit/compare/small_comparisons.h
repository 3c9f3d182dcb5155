// Comparisons and pictures made by hand, for tests of what is said of them.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/picture_pair.h"

namespace plumb::compare::testing {

/// Colours and depth, floats: a grey hill under a sky (Z infinite) in the upper quarter.
inline image::PlaneImage hill_picture(int width_px, int height_px) {
  image::PlaneImage picture;
  picture.width_px = width_px;
  picture.height_px = height_px;
  for (const char* name : {"R", "G", "B", "Z"})
    picture.planes.push_back({name, std::vector<float>(picture.size(), 0.0f)});
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const std::size_t k = static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(x);
      const bool sky = 4 * y < height_px;
      const float shade =
          0.1f + 0.6f * static_cast<float>(x + y) / static_cast<float>(width_px + height_px);
      picture.planes[0].values[k] = sky ? 0.35f : shade;
      picture.planes[1].values[k] = sky ? 0.5f : 0.9f * shade;
      picture.planes[2].values[k] = sky ? 0.8f : 0.6f * shade;
      picture.planes[3].values[k] =
          sky ? std::numeric_limits<float>::infinity()
              : 4000.0f - 3900.0f * static_cast<float>(y) / static_cast<float>(height_px);
    }
  }
  return picture;
}

/// The hill, and the same with a crack one pixel wide: sky seen through column `crack_x` in rows
/// [3/8, 6/8) of the height.
inline PicturePair cracked_pair(int width_px = 32, int height_px = 16, int crack_x = 20) {
  PicturePair pair{"ref/hill.exr",
                   "out/hill.exr",
                   hill_picture(width_px, height_px),
                   hill_picture(width_px, height_px),
                   {}};
  for (int y = 3 * height_px / 8; y < 6 * height_px / 8; ++y) {
    const std::size_t k =
        static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(crack_x);
    pair.candidate.planes[0].values[k] = 0.35f;
    pair.candidate.planes[1].values[k] = 0.5f;
    pair.candidate.planes[2].values[k] = 0.8f;
    pair.candidate.planes[3].values[k] = std::numeric_limits<float>::infinity();
  }
  return pair;
}

/// 8-bit colours alone, without depth.
inline PicturePair colours_only(PicturePair pair) {
  for (image::PlaneImage* picture : {&pair.reference, &pair.candidate}) {
    picture->encoding = image::Encoding::Srgb;
    picture->bits = 8;
    picture->planes.resize(3);
  }
  return pair;
}

/// Depth alone.
inline PicturePair depth_only(PicturePair pair) {
  for (image::PlaneImage* picture : {&pair.reference, &pair.candidate})
    picture->planes.erase(picture->planes.begin(), picture->planes.begin() + 3);
  return pair;
}

inline Judgement judged(const Measurement& measured, double bound, bool holds) {
  return {{measured.group, measured.channel, measured.metric, measured.threshold, bound},
          measured,
          holds};
}

/// Largest difference of the colours at each pixel; NaN where the mask does not judge.
inline ErrorMap colour_map(const PicturePair& pair) {
  ErrorMap map{"colour difference", "largest difference of a channel", "", {}, 0.1};
  for (std::size_t k = 0; k < pair.size(); ++k) {
    float worst = 0.0f;
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(worst, std::fabs(pair.reference.planes[c].values[k] -
                                        pair.candidate.planes[c].values[k]));
    map.values.push_back(pair.judged(k) ? worst : std::numeric_limits<float>::quiet_NaN());
  }
  return map;
}

/// What might be said of the cracked pair: fails by coverage and by its largest difference.
inline Comparison cracked_comparison(const PicturePair& pair) {
  const int x = 20 * pair.width_px() / 32, y = pair.height_px() / 2;
  Comparison c;
  c.reference_name = pair.reference_name;
  c.candidate_name = pair.candidate_name;
  c.width_px = pair.width_px();
  c.height_px = pair.height_px();
  c.encoding = "linear, floats";
  c.channels = {"R", "G", "B", "Z"};
  c.profile = "default";
  const Measurement largest{"colour", "", "largest", {}, 0.43, x, y};
  const Measurement share{"colour", "", "share_over", 0.02, 1.171875};
  const Measurement psnr{"colour", "", "psnr", {}, 38.25};
  const Measurement flip{"colour", "", "flip_mean", {}, 0.0123};
  const Measurement holes{"coverage", "", "holes", {}, 6.0, x, y};
  const Measurement channel{"channel", "N.X", "largest", {}, 0.0};
  const Measurement infinite{"channel", "B", "psnr", {}, {}};
  c.measurements = {largest, share, psnr, flip, holes, channel, infinite};
  c.judgements = {judged(psnr, 30.0, true), judged(largest, 0.1, false), judged(holes, 0.0, false),
                  judged(flip, 0.05, true)};
  c.not_judged = {"normal.largest_deg"};
  c.coverage = check_coverage(*shown_terrain(pair.reference), *shown_terrain(pair.candidate),
                              pair.width_px(), pair.height_px());
  c.maps = {colour_map(pair)};
  c.worst = {{x, y, "hole", 1.0, "", "Z 2050", "Z inf"},
             {x, y - 1, "colour", 0.43, "", "0.38 0.35 0.23", "0.35 0.5 0.8"}};
  c.notes = {"the eye is 0.5 m off"};
  c.reasons = {"6 pixels show sky where terrain must be, the first at (20, 8)",
               "the largest difference is 0.43 where at most 0.1 is allowed"};
  c.verdict = CompareVerdict::Fails;
  return c;
}

inline Comparison equal_comparison(const std::string& name) {
  Comparison c;
  c.reference_name = "ref/" + name;
  c.candidate_name = "out/" + name;
  c.width_px = c.height_px = 4;
  c.encoding = "sRGB, 8 bits";
  c.channels = {"R", "G", "B"};
  c.profile = "default";
  c.measurements = {{"colour", "", "largest", {}, 0.0}, {"colour", "", "psnr", {}, {}}};
  c.judgements = {judged(c.measurements[0], 0.1, true)};
  return c;
}

/// Passes with this share of its only limit used.
inline Comparison passing_comparison(const std::string& name, double use) {
  Comparison c = equal_comparison(name);
  c.measurements[0].value = 0.1 * use;
  c.judgements = {judged(c.measurements[0], 0.1, true)};
  c.verdict = CompareVerdict::Passes;
  return c;
}

}  // namespace plumb::compare::testing
