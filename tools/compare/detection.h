// What a profile catches: the rate at which it fails pictures with defects planted in them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "compare/planted_scene.h"
#include "compare/profile.h"
#include "image/plane_image.h"

namespace plumb::compare {

/// A kind of defect, or of harmless difference.
struct DefectKind {
  const char* name;     // "crack-1px"
  const char* meaning;  // one line
  bool harmless;        // a comparison should pass it
  bool of_scene;        // needs a scene to be drawn, a picture is not enough
};

/// Noise, jitter, shifts, cracks of 1 to 3 px, pinholes, a missing tile, levels of detail of
/// strides 2 to 16, wrong normals, wrong gamma.
const std::vector<DefectKind>& defect_kinds();

/// A picture that was harmed, and how.
struct HarmedPicture {
  const DefectKind* kind;
  image::PlaneImage reference, picture;
};

enum class Channels { All, ColoursAlone };

/// One of each kind, at places that follow from the seed. Where colours are alone, both pictures
/// are 8-bit sRGB, and noise is a step of their own codes.
std::vector<HarmedPicture> harmed_pictures(const PlantedScene& scene, std::uint64_t seed,
                                           Channels channels);
/// The harmless kinds alone.
std::vector<HarmedPicture> harmless_pictures(const PlantedScene& scene, std::uint64_t seed,
                                             Channels channels);
/// Those kinds that need no scene; shifts are resampled.
std::vector<HarmedPicture> harmed_pictures(const image::PlaneImage& reference, std::uint64_t seed,
                                           Channels channels);

/// How often each kind failed.
struct DetectionRow {
  const DefectKind* kind;
  int pictures = 0;
  int failed = 0;                        // by the profile
  std::map<std::string, int> caught_by;  // check, and how often it was broken
  std::vector<int> failed_by_others;     // as DetectionTable::others
  std::vector<std::string> wrong;        // where the verdict was not the wanted one

  double rate() const { return pictures > 0 ? static_cast<double>(failed) / pictures : 0.0; }
  /// A harmless one never failed, a defect always did.
  bool as_wanted() const { return kind->harmless ? failed == 0 : failed == pictures; }
  /// The checks that are broken most often, most often first, at most `most`.
  std::vector<std::string> best_checks(std::size_t most) const;
};

struct DetectionTable {
  std::vector<std::string> others;  // names of other_rules(); empty where they are not judged
  std::vector<DetectionRow> rows;   // in the order of defect_kinds()

  /// Adds pictures to the rows of their kinds; `where` names the scene or picture ("alpine, seed
  /// 3").
  void judge(const std::vector<HarmedPicture>& pictures, const Profile& profile,
             const std::string& where);
  bool as_wanted() const;
};

/// A table with a row for each kind; with_others: all other_rules() are judged as well.
DetectionTable empty_detection_table(bool with_others);

/// Over all the terrains and seeds 1 to `seeds`; `step` is called before each scene.
struct DetectionOptions {
  std::vector<std::string> terrains{"alpine", "canyon", "urban"};
  PlantedSceneOptions scene;  // its terrain and seed are replaced
  int seeds = 10;             // >= 1
  Channels channels = Channels::All;
  bool with_others = false;
};
DetectionTable detection_power(const Profile& profile, const DetectionOptions& options,
                               const std::function<void(const std::string&)>& step = {});

}  // namespace plumb::compare
