#include "compare/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "compare/measuring.h"
#include "compare/worst_pixels.h"
#include "core/check.h"
#include "image/camera_metadata.h"

namespace plumb::compare {
namespace {

// Masked pixels of the candidate are the reference's, so that no neighbourhood sees them differ.
PicturePair masked(const PicturePair& pair) {
  PicturePair result = pair;
  for (image::Plane& plane : result.candidate.planes) {
    const image::Plane& from = *pair.reference.find(plane.name);
    for (std::size_t k = 0; k < plane.values.size(); ++k) {
      if (!pair.judged(k)) plane.values[k] = from.values[k];
    }
  }
  return result;
}

// Pictures that say nothing of what is masked: what is fitted to all must not see it.
image::PlaneImage without_masked(const PicturePair& pair, const image::PlaneImage& picture) {
  image::PlaneImage result = picture;
  for (image::Plane& plane : result.planes) {
    for (std::size_t k = 0; k < plane.values.size(); ++k) {
      if (!pair.judged(k)) plane.values[k] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return result;
}

std::vector<Diagnosis> diagnose_judged(const PicturePair& pair) {
  if (pair.mask.empty()) return diagnose(pair.reference, pair.candidate);
  return diagnose(without_masked(pair, pair.reference), without_masked(pair, pair.candidate));
}

bool equal_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || a == b ||
         (std::isnan(a) && std::isnan(b));
}

bool all_equal(const PicturePair& pair) {
  for (const image::Plane& plane : pair.reference.planes) {
    const image::Plane& other = *pair.candidate.find(plane.name);
    if (!std::equal(plane.values.begin(), plane.values.end(), other.values.begin(), equal_bits))
      return false;
  }
  return true;
}

// Differences in what the headers say of the scene: the pictures show two things.
void compare_headers(const PicturePair& pair, Comparison& result) {
  const auto a = image::camera_of(pair.reference.metadata),
             b = image::camera_of(pair.candidate.metadata);
  if (a && b && !(*a == *b)) {
    const glm::dvec3 moved = b->eye_m - a->eye_m;
    result.notes.push_back(fmt::format(
        "the headers name different cameras: the candidate's eye is moved by ({:.6g}, {:.6g}, "
        "{:.6g}) m, its pixels span {:.6g} of the reference's angle",
        moved.x, moved.y, moved.z, a->gamma_v / b->gamma_v));
  }
  const auto checksum = [](const image::PlaneImage& picture) -> const std::string* {
    const auto found = picture.metadata.find("terrain.checksum");
    return found == picture.metadata.end() ? nullptr : std::get_if<std::string>(&found->second);
  };
  const std::string *here = checksum(pair.reference), *there = checksum(pair.candidate);
  if (here != nullptr && there != nullptr && *here != *there)
    result.notes.push_back(
        fmt::format("the headers name different terrains: checksum {}, the "
                    "reference's is {}",
                    *there, *here));
}

void judge(const Profile& profile, Comparison& result) {
  for (const Limit& limit : profile.limits) {
    const std::size_t before = result.judgements.size();
    for (const Measurement& measured : result.measurements) {
      if (limit.is_about(measured))
        result.judgements.push_back({limit, measured, limit.holds(measured)});
    }
    if (result.judgements.size() == before)
      result.not_judged.push_back(
          Measurement{limit.group, limit.channel, limit.metric, limit.threshold}.name());
  }
}

// Whether limits of a group speak of a channel.
bool speaks_of(const std::string& group, const std::string& limited, const image::Plane& plane,
               bool coverage_is_alpha) {
  const std::string& channel = plane.name;
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), channel) != names.end();
  };
  if (group == "channel") return limited == channel;
  if (group == "colour" || group == "others") return is_one_of({"R", "G", "B", "Y"});
  if (group == "coverage") return coverage_is_alpha ? channel == "A" : channel == "Z";
  if (group == "depth") return channel == "Z";
  if (group == "alpha") return channel == "A";
  if (group == "position") return channel.starts_with("P.");
  if (group == "normal") return channel.starts_with("N.");
  return group == channel;
}

// A profile that says nothing of a channel passes whatever is in it.
void note_unlimited(const PicturePair& pair, Comparison& result) {
  const bool by_alpha = result.sky && result.sky->kind == SkyRule::Kind::Alpha;
  std::string names;
  for (const image::Plane& plane : pair.reference.planes) {
    const bool limited =
        std::any_of(result.judgements.begin(), result.judgements.end(), [&](const Judgement& each) {
          return speaks_of(each.limit.group, each.measured.channel, plane, by_alpha);
        });
    if (!limited) names += " " + plane.name;
  }
  if (!names.empty()) result.notes.push_back("no limit of the profile speaks of:" + names);
}

std::string with_unit(double value, const char* unit) {
  return fmt::format("{:.6g}{}{}", value, *unit == '\0' ? "" : " ", unit);
}

void find_reasons(const Profile& profile, Comparison& result) {
  if (profile.judges_systematic) {
    for (const Diagnosis& each : result.systematic) result.reasons.push_back(each.text);
  }
  if (profile.judges_numbers && result.numbers.unlike > 0)
    result.reasons.push_back(
        fmt::format("numbers that are not finite in one picture alone, or not the same: {}; the "
                    "first: {}",
                    result.numbers.unlike, result.numbers.first));
  for (const Judgement& each : result.judgements) {
    if (each.holds) continue;
    const Metric& metric = each.measured.info();
    std::string text = fmt::format("{} is {}, {} {} is allowed: {}", each.measured.name(),
                                   with_unit(each.measured.value.value_or(0.0), metric.unit),
                                   metric.more_is_better ? "at least" : "at most",
                                   with_unit(each.limit.bound, metric.unit), metric.meaning);
    if (each.measured.x >= 0)
      text += fmt::format("; first or worst at ({}, {})", each.measured.x, each.measured.y);
    result.reasons.push_back(std::move(text));
  }
}

CompareVerdict verdict_of(const Comparison& result, bool equal) {
  if (!result.reasons.empty()) return CompareVerdict::Fails;
  if (equal) return CompareVerdict::Equal;
  return result.judgements.empty() ? CompareVerdict::None : CompareVerdict::Passes;
}

MaskReport report_mask(const PicturePair& pair, const Profile& profile) {
  MaskReport report;
  for (const std::uint8_t judged : pair.mask) report.masked += judged == 0;
  PicturePair whole = pair;
  whole.mask.clear();
  for (std::size_t k = 0; k < pair.size(); ++k) {
    if (pair.judged(k)) continue;
    report.would_differ += std::any_of(
        pair.reference.planes.begin(), pair.reference.planes.end(), [&](const image::Plane& p) {
          return !equal_bits(p.values[k], pair.candidate.find(p.name)->values[k]);
        });
  }
  Comparison unmasked;
  const CompareOptions options{.most_listed = 0, .with_maps = true, .everything = false};
  const Measuring measuring{whole, profile, options, unmasked};
  measure_colour(measuring);
  measure_depth(measuring);
  measure_positions(measuring);
  measure_normals(measuring);
  measure_coverage(measuring);
  report.would_fail =
      pixels_over_limits(unmasked.maps, [&](std::size_t k) { return !pair.judged(k); });
  return report;
}

std::string kind_of(const image::PlaneImage& picture) {
  return picture.bits > 0
             ? fmt::format("{}, {} bits", image::name_of(picture.encoding), picture.bits)
             : fmt::format("{}, floats", image::name_of(picture.encoding));
}

}  // namespace

const char* name_of(CompareVerdict verdict) {
  switch (verdict) {
    case CompareVerdict::Equal:
      return "equal";
    case CompareVerdict::Passes:
      return "passes";
    case CompareVerdict::Fails:
      return "fails";
    case CompareVerdict::None:
      return "none";
  }
  return "?";
}

Comparison compare_pictures(const PicturePair& given, const Profile& profile,
                            const CompareOptions& options) {
  require_comparable(given);
  Comparison result;
  if (!given.mask.empty()) result.mask = report_mask(given, profile);
  const PicturePair pair = given.mask.empty() ? PicturePair{} : masked(given);
  const PicturePair& judged = given.mask.empty() ? given : pair;
  result.reference_name = judged.reference_name;
  result.candidate_name = judged.candidate_name;
  result.width_px = judged.width_px();
  result.height_px = judged.height_px();
  result.encoding = kind_of(judged.reference);
  for (const image::Plane& plane : judged.reference.planes) result.channels.push_back(plane.name);
  result.profile = profile.name;
  const bool equal = all_equal(judged);
  if (!equal && (profile.judges_systematic || options.everything))
    result.systematic = diagnose_judged(judged);
  const Measuring measuring{judged, profile, options, result};
  measure_coverage(measuring);
  measure_colour(measuring);
  measure_depth(measuring);
  measure_positions(measuring);
  measure_normals(measuring);
  measure_names(measuring);
  measure_channels(measuring);
  measure_others(measuring);
  compare_headers(judged, result);
  judge(profile, result);
  if (!equal) note_unlimited(judged, result);
  find_reasons(profile, result);
  result.verdict = verdict_of(result, equal);
  result.worst = worst_pixels(judged, result.maps, options.most_listed);
  if (!options.with_maps) result.maps.clear();
  return result;
}

}  // namespace plumb::compare
