#include "compare/detection.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/comparison.h"
#include "compare/others_rules.h"
#include "compare/planted_defects.h"
#include "core/check.h"

namespace plumb::compare {
namespace {

// Systematic differences by what they are of.
std::string group_of(Systematic kind) {
  switch (kind) {
    case Systematic::Shift:
      return "named: shift";
    case Systematic::Offset:
    case Systematic::Gain:
    case Systematic::LinearAsSrgb:
    case Systematic::SrgbAsLinear:
    case Systematic::Gamma:
      return "named: values";
    case Systematic::FlippedX:
    case Systematic::FlippedY:
      return "named: flip";
    case Systematic::FieldOfViewAxis:
      return "named: field of view";
    case Systematic::DepthScale:
    case Systematic::WindowDepth:
    case Systematic::DistanceAsDepth:
      return "named: depth";
  }
  return "named";
}

void count(const Comparison& comparison, const std::string& where, DetectionRow& row) {
  ++row.pictures;
  row.failed += !comparison.passes();
  if (comparison.passes() != row.kind->harmless) row.wrong.push_back(where);
  if (!comparison.systematic.empty()) ++row.caught_by[group_of(comparison.systematic.front().kind)];
  if (comparison.numbers.unlike > 0) ++row.caught_by["numbers that are not finite"];
  for (const Judgement& each : comparison.judgements) {
    if (!each.holds) ++row.caught_by[each.measured.name()];
  }
}

}  // namespace

std::vector<std::string> DetectionRow::best_checks(std::size_t most) const {
  std::vector<std::pair<std::string, int>> order(caught_by.begin(), caught_by.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(most, order.size()); ++k) names.push_back(order[k].first);
  return names;
}

DetectionTable empty_detection_table(bool with_others) {
  DetectionTable table;
  if (with_others) {
    for (const OtherRule& rule : other_rules()) table.others.emplace_back(rule.name);
  }
  for (const DefectKind& kind : defect_kinds())
    table.rows.push_back({&kind, 0, 0, {}, std::vector<int>(table.others.size(), 0), {}});
  return table;
}

void DetectionTable::judge(const std::vector<HarmedPicture>& pictures, const Profile& profile,
                           const std::string& where) {
  for (const HarmedPicture& each : pictures) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const DetectionRow& candidate) {
      return candidate.kind == each.kind;
    });
    const PicturePair pair{"reference", each.kind->name, each.reference, each.picture};
    count(compare_pictures(pair, profile,
                           {.most_listed = 0, .with_maps = false, .everything = false}),
          where, *row);
    if (others.empty()) continue;
    const std::vector<OtherVerdict> verdicts =
        judge_by(other_rules(), bytes_of(each.reference), bytes_of(each.picture));
    for (std::size_t k = 0; k < verdicts.size(); ++k)
      row->failed_by_others[k] += !verdicts[k].passes;
  }
}

bool DetectionTable::as_wanted() const {
  return std::all_of(rows.begin(), rows.end(),
                     [](const DetectionRow& row) { return row.as_wanted(); });
}

DetectionTable detection_power(const Profile& profile, const DetectionOptions& options,
                               const std::function<void(const std::string&)>& step) {
  require(options.seeds >= 1 && !options.terrains.empty(),
          "detection needs at least one terrain and seed, got {} and {}", options.terrains.size(),
          options.seeds);
  DetectionTable table = empty_detection_table(options.with_others);
  for (int seed = 1; seed <= options.seeds; ++seed) {
    for (const std::string& terrain : options.terrains) {
      if (step) step(fmt::format("{}, seed {} of {}", terrain, seed, options.seeds));
      PlantedSceneOptions scene = options.scene;
      scene.terrain = terrain;
      scene.seed = static_cast<std::uint64_t>(seed);
      table.judge(harmed_pictures(PlantedScene(scene), scene.seed, options.channels), profile,
                  fmt::format("{}, seed {}", terrain, seed));
    }
  }
  return table;
}

}  // namespace plumb::compare
