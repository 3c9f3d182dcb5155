// One picture of each kind of defect.
#include <stdexcept>
#include <string>
#include <utility>

#include "compare/detection.h"
#include "compare/planted_defects.h"
#include "core/reproducible_math.h"

namespace plumb::compare {
namespace {

using image::PlaneImage;

constexpr int kCrackLength_px = 60, kPinholes = 40, kTile_px = 12;
constexpr double kJitterOfSamplers_px = 0.1;

const DefectKind& kind_named(const std::string& name) {
  for (const DefectKind& kind : defect_kinds()) {
    if (name == kind.name) return kind;
  }
  throw std::logic_error("no kind of defect is called " + name);
}

// Collects pictures of one reference.
class Harm {
 public:
  Harm(const PlaneImage& reference, std::uint64_t seed, Channels channels)
      : all_(reference), channels_(channels), places_(seed) {
    reference_ = channels == Channels::All ? reference : colours_alone(reference);
  }

  void add(const std::string& name, const PlaneImage& picture) {
    add_shown(name, channels_ == Channels::All ? picture : colours_alone(picture));
  }
  // Harm that is done to what is compared, not to what is drawn.
  void add_shown(const std::string& name, PlaneImage picture) {
    pictures_.push_back({&kind_named(name), reference_, std::move(picture)});
  }

  void add_noise() { add_shown("noise", with_least_bit_noise(reference_, places_)); }
  void add_jitter(const PlantedScene& scene) {
    const double angle = 6.283185307179586 * places_.share();
    add("jitter-0.1px", scene.shifted(kJitterOfSamplers_px * reproducible_cos(angle),
                                      kJitterOfSamplers_px * reproducible_sin(angle)));
  }
  void add_of_pictures() {
    for (const int width : {1, 2, 3})
      add("crack-" + std::to_string(width) + "px",
          with_crack(all_, width, kCrackLength_px, places_));
    add("pinholes", with_pinholes(all_, kPinholes, places_));
    add("missing-tile", with_missing_tile(all_, kTile_px, places_));
    add_noise();
    add_shown("wrong-gamma", encoded_twice(reference_));
  }

  std::vector<HarmedPicture> take() { return std::move(pictures_); }

 private:
  const PlaneImage& all_;
  Channels channels_;
  Places places_;
  PlaneImage reference_;
  std::vector<HarmedPicture> pictures_;
};

}  // namespace

const std::vector<DefectKind>& defect_kinds() {
  static const std::vector<DefectKind> kinds{
      {"noise", "one step of 8 bits more, less or none on every channel and pixel", true, false},
      {"jitter-0.1px", "the image plane moved by 0.1 px in any direction", true, true},
      {"shift-0.5px", "moved by half a pixel, right and down", false, false},
      {"shift-1px", "moved by a pixel to the right", false, false},
      {"crack-1px", "sky through a gap 60 px long, 1 px wide, at any angle and place", false,
       false},
      {"crack-2px", "the same, 2 px wide", false, false},
      {"crack-3px", "the same, 3 px wide", false, false},
      {"pinholes", "sky through 40 single pixels", false, false},
      {"missing-tile", "sky through a square of 12 px", false, false},
      {"lod-2", "every second sample of the terrain alone", false, true},
      {"lod-4", "every fourth", false, true},
      {"lod-8", "every eighth", false, true},
      {"lod-16", "every sixteenth", false, true},
      {"wrong-normals", "normals whose north component has the wrong sign", false, true},
      {"wrong-gamma", "colours encoded for the screen twice", false, false}};
  return kinds;
}

std::vector<HarmedPicture> harmed_pictures(const PlantedScene& scene, std::uint64_t seed,
                                           Channels channels) {
  const PlaneImage reference = scene.drawn();
  Harm harm(reference, seed, channels);
  harm.add_jitter(scene);
  harm.add("shift-0.5px", scene.shifted(0.5, 0.5));
  harm.add("shift-1px", scene.shifted(1.0, 0.0));
  harm.add_of_pictures();
  harm.add("lod-2", scene.with_level_of_detail(2));
  harm.add("lod-4", scene.with_level_of_detail(4));
  harm.add("lod-8", scene.with_level_of_detail(8));
  harm.add("lod-16", scene.with_level_of_detail(16));
  harm.add("wrong-normals", scene.with_wrong_normals());
  return harm.take();
}

std::vector<HarmedPicture> harmless_pictures(const PlantedScene& scene, std::uint64_t seed,
                                             Channels channels) {
  const PlaneImage reference = scene.drawn();
  Harm harm(reference, seed, channels);
  harm.add_jitter(scene);
  harm.add_noise();
  return harm.take();
}

std::vector<HarmedPicture> harmed_pictures(const PlaneImage& reference, std::uint64_t seed,
                                           Channels channels) {
  Harm harm(reference, seed, channels);
  harm.add("shift-0.5px", moved(reference, 0.5, 0.5));
  harm.add("shift-1px", moved(reference, 1.0, 0.0));
  harm.add_of_pictures();
  return harm.take();
}

}  // namespace plumb::compare
