#include "terrain/stacks/stack_aggregation.h"

#include <algorithm>

#include "core/check.h"

namespace plumb::terrain {
namespace {

using Segment = Aggregation::Segment;

int count_of(const Segment& segment, Material material, int stacks) {
  int count = 0;
  for (int k = 0; k < stacks; ++k)
    count += segment.materials[static_cast<std::size_t>(k)] == material ? 1 : 0;
  return count;
}

bool has_tied(const Segment& segment, Material material) {
  for (int k = 0; k < segment.ties; ++k)
    if (segment.tied[static_cast<std::size_t>(k)] == material) return true;
  return false;
}

void find_ties(Segment& segment, int stacks) {
  int most = 0;
  for (int k = 0; k < stacks; ++k) {
    const Material material = segment.materials[static_cast<std::size_t>(k)];
    const int count = count_of(segment, material, stacks);
    if (count > most) segment.ties = 0;
    most = std::max(most, count);
    if (count == most && !has_tied(segment, material))
      segment.tied[static_cast<std::size_t>(segment.ties++)] = material;
  }
}

// Step 1.
void cut(std::span<const StackView> stacks, float high_m, std::vector<Segment>& segments) {
  segments.clear();
  std::array<std::size_t, 4> at{};  // layer of each stack; its size: the air above
  for (float start_m = stacks[0].low_m; start_m < high_m;) {
    Segment segment;
    segment.start_m = start_m;
    segment.end_m = high_m;
    for (std::size_t k = 0; k < stacks.size(); ++k) {
      const bool is_air = at[k] == stacks[k].size();
      segment.materials[k] = is_air ? kAir : stacks[k].material[at[k]];
      if (!is_air) segment.end_m = std::min(segment.end_m, stacks[k].end_m[at[k]]);
    }
    for (std::size_t k = 0; k < stacks.size(); ++k)
      at[k] += at[k] < stacks[k].size() && stacks[k].end_m[at[k]] <= segment.end_m ? 1 : 0;
    find_ties(segment, static_cast<int>(stacks.size()));
    start_m = segment.end_m;
    segments.push_back(segment);
  }
}

void put(std::vector<Layer>& layers, float end_m, float low_m, Material material) {
  const float start_m = layers.empty() ? low_m : layers.back().end_m;
  if (!(end_m > start_m)) return;  // half of a segment one float high
  if (!layers.empty() && layers.back().material == material) {
    layers.back().end_m = end_m;
  } else {
    layers.push_back({start_m, end_m, material});
  }
}

double thickness_of(std::span<const Segment> segments, Material material, int stacks) {
  double sum_m = 0.0;
  for (const Segment& segment : segments)
    sum_m += count_of(segment, material, stacks) *
             (static_cast<double>(segment.end_m) - static_cast<double>(segment.start_m));
  return sum_m;
}

// Step 3.
Material thickest(std::span<const Segment> segments, const Segment& tied, int stacks) {
  Material best = tied.tied[0];
  double best_m = thickness_of(segments, best, stacks);
  for (int k = 1; k < tied.ties; ++k) {
    const Material other = tied.tied[static_cast<std::size_t>(k)];
    const double other_m = thickness_of(segments, other, stacks);
    const bool is_before = best == kAir || (other != kAir && other < best);
    if (other_m > best_m || (other_m == best_m && is_before)) {
      best = other;
      best_m = other_m;
    }
  }
  return best;
}

struct Votes {
  bool has_below = false, has_above = false;
  Material below = kAir, above = kAir;
};

// Step 2, for the tied segment `at`: the nearest votes.
Votes nearest_votes(std::span<const Segment> segments, std::size_t at) {
  Votes votes;
  const auto is_vote = [&](const Segment& segment) {
    return segment.ties == 1 && has_tied(segments[at], segment.tied[0]);
  };
  const std::size_t reach = std::max(at, segments.size() - 1 - at);
  for (std::size_t w = 1; w <= reach && !votes.has_below && !votes.has_above; ++w) {
    if (w <= at && is_vote(segments[at - w])) {
      votes.has_below = true;
      votes.below = segments[at - w].tied[0];
    }
    if (at + w < segments.size() && is_vote(segments[at + w])) {
      votes.has_above = true;
      votes.above = segments[at + w].tied[0];
    }
  }
  return votes;
}

float middle_of(const Segment& segment) {
  return static_cast<float>(
      0.5 * (static_cast<double>(segment.start_m) + static_cast<double>(segment.end_m)));
}

}  // namespace

void aggregate(std::span<const StackView> stacks, float high_m, Aggregation& result) {
  require(stacks.size() >= 1 && stacks.size() <= 4, "1 to 4 stacks make one, got {}",
          stacks.size());
  for (const StackView& stack : stacks)
    require(stack.low_m == stacks[0].low_m, "stacks must begin at one height, got {} and {} m",
            stacks[0].low_m, stack.low_m);
  cut(stacks, high_m, result.segments);
  result.layers.clear();
  result.by_thickness = 0;
  const float low_m = stacks[0].low_m;
  for (std::size_t at = 0; at < result.segments.size(); ++at) {
    const Segment& segment = result.segments[at];
    if (segment.ties == 1) {
      put(result.layers, segment.end_m, low_m, segment.tied[0]);
      continue;
    }
    const Votes votes = nearest_votes(result.segments, at);
    if (!votes.has_below && !votes.has_above) {
      ++result.by_thickness;
      put(result.layers, segment.end_m, low_m,
          thickest(result.segments, segment, static_cast<int>(stacks.size())));
      continue;
    }
    if (votes.has_below && votes.has_above && votes.below != votes.above)
      put(result.layers, middle_of(segment), low_m, votes.below);
    put(result.layers, segment.end_m, low_m, votes.has_above ? votes.above : votes.below);
  }
}

}  // namespace plumb::terrain
