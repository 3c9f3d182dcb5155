#include "audit/verdict_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::audit {
namespace {

bool is_of_frame(const ClaimResult& claim) { return claim.claim.scope == Scope::Frame; }

std::string held_sentence(const AuditResult& result, const std::string& not_measured) {
  const auto held = std::count_if(
      result.claims.begin(), result.claims.end(),
      [](const ClaimResult& claim) { return is_of_frame(claim) && claim.is_measured; });
  const bool out_of_reach =
      std::any_of(result.claims.begin(), result.claims.end(),
                  [](const ClaimResult& claim) { return claim.claim.unreachable; });
  const char* reach =
      out_of_reach ? " The tolerance asked for is out of reach: more than it is claimed." : "";
  if (not_measured.empty())
    return fmt::format(
        "Every claim holds: {} of the frame and {} of patches, coverage among them.{}", held,
        result.patch_claims, reach);
  return fmt::format(
      "Every claim that could be measured holds: {} of the frame and {} of patches; not measured: "
      "{}.{}",
      held, result.patch_claims, not_measured, reach);
}

std::string broken_sentence(const AuditResult& result, const std::string& not_measured) {
  std::string broken;
  const auto add = [&](const std::string& part) { broken += (broken.empty() ? "" : "; ") + part; };
  for (const ClaimResult& c : result.claims) {
    if (c.is_broken() && is_of_frame(c))
      add(fmt::format("{} {} where {} was {}", c.label, with_unit(c.measured, c.claim.unit),
                      with_unit(c.claim.bound, c.claim.unit),
                      c.is_limit ? "the limit" : "claimed"));
  }
  if (result.patch_claims_broken > 0)
    add(fmt::format("{} over {} own bound{}",
                    result.patch_claims_broken == 1
                        ? "a patch"
                        : fmt::format("{} patches", result.patch_claims_broken),
                    result.patch_claims_broken == 1 ? "its" : "their",
                    result.patch_claims_broken == 1 ? "" : "s"));
  if (!result.registration.agrees) add("the picture was not made with this camera");
  if (!not_measured.empty()) broken += "; not measured: " + not_measured;
  return "Broken: " + broken + ".";
}

std::string place_text(const Offender& o) {
  std::string text =
      o.breaks.empty() || o.breaks == o.what ? o.what : fmt::format("{} ({})", o.breaks, o.what);
  if (o.unit != Unit::Count) text += " " + with_unit(o.value, o.unit);
  text += o.x >= 0 ? fmt::format(" at pixel ({}, {})", o.x, o.y) : " out of view";
  text += fmt::format(", world ({:.8g}, {:.8g}, {:.7g})", o.world_m.x, o.world_m.y, o.world_m.z);
  if (o.triangle != kNoPrimitive) text += fmt::format(", triangle {}", o.triangle);
  if (o.patch >= 0) text += fmt::format(", patch {} ({})", o.patch, o.patch_name);
  return text;
}

}  // namespace

std::string short_number(double value) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return fmt::format("{:.4g}", value);
}

std::string with_unit(double value, Unit unit) {
  const std::string number = short_number(value);
  return unit == Unit::Count ? number : number + " " + name_of(unit);
}

const char* verdict_word(const ClaimResult& claim) {
  if (claim.holds) return claim.claim.unreachable ? "held, out of reach" : "held";
  return claim.is_measured ? "BROKEN" : "not measured";
}

std::string verdict_sentence(const AuditResult& result) {
  std::string not_measured;
  for (const ClaimResult& claim : result.claims) {
    if (is_of_frame(claim) && !claim.is_measured)
      not_measured += (not_measured.empty() ? "" : ", ") + claim.label;
  }
  switch (result.verdict()) {
    case Verdict::Held:
      return held_sentence(result, not_measured);
    case Verdict::Broken:
      return broken_sentence(result, not_measured);
    case Verdict::None:
      break;
  }
  return fmt::format("No verdict: {}.", result.no_verdict);
}

std::vector<std::string> worst_lines(const AuditResult& result) {
  std::vector<const ClaimResult*> told;
  for (const bool of_frame : {true, false}) {
    for (const ClaimResult& claim : result.claims) {
      if (!claim.is_broken() || claim.places.empty() || is_of_frame(claim) != of_frame) continue;
      const bool is_told = std::any_of(told.begin(), told.end(), [&](const ClaimResult* other) {
        return other->label == claim.label && other->claim.unit == claim.claim.unit;
      });
      if (!is_told && (of_frame || told.empty())) told.push_back(&claim);
    }
  }
  std::vector<std::string> lines;
  for (const ClaimResult* claim : told)
    lines.push_back("worst: " + place_text(claim->places.front()));
  return lines;
}

}  // namespace plumb::audit
