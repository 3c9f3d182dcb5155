#include "compare/worst_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace plumb::compare {
namespace {

// The channels that a map is made of.
std::vector<const char*> channels_of(const std::string& map) {
  if (map == "depth" || map == "coverage") return {"Z", "A"};
  if (map == "position") return {"P.X", "P.Y", "P.Z"};
  if (map == "normal") return {"N.X", "N.Y", "N.Z"};
  return {"R", "G", "B", "Y"};
}

std::string numbers_at(const image::PlaneImage& picture, const std::string& map, std::size_t k) {
  std::string text;
  for (const char* name : channels_of(map)) {
    const image::Plane* plane = picture.find(name);
    if (plane == nullptr) continue;
    const float value = plane->values[k];
    text += (text.empty() ? "" : " ") + (picture.bits == 8
                                             ? fmt::format("{}", std::lround(value * 255.0f))
                                             : fmt::format("{:.6g}", value));
  }
  return text;
}

bool breaks_limit(const ErrorMap& map) {
  if (!map.limit) return false;
  return std::any_of(map.values.begin(), map.values.end(),
                     [&](float value) { return double{value} > *map.limit; });
}

// Bits of positive floats ascend with their values; their upper half names one of these.
constexpr std::size_t kRanges = 1u << 15;

std::size_t range_of(float value) { return std::bit_cast<std::uint32_t>(value) >> 16; }

// Places of a map's positive values, worst first, some thousand at a time, so that a few of two
// million are found without all of them sorted.
class WorstFirst {
 public:
  explicit WorstFirst(const std::vector<float>& values) : values_(values), count_of_(kRanges, 0) {
    for (const float value : values)
      if (value > 0.0f) ++count_of_[range_of(value)];
  }

  // The next ones; none if there are no more.
  std::span<const std::size_t> next() {
    if (given_ == places_.size()) gather();
    const auto begin = places_.begin() + static_cast<std::ptrdiff_t>(given_);
    const std::size_t count = std::min(kSome, places_.size() - given_);
    std::partial_sort(begin, begin + static_cast<std::ptrdiff_t>(count), places_.end(),
                      [&](std::size_t a, std::size_t b) {
                        return values_[a] != values_[b] ? values_[a] > values_[b] : a < b;
                      });
    given_ += count;
    return {begin, count};
  }

 private:
  static constexpr std::size_t kSome = 4096;

  // The places of the next ranges.
  void gather() {
    std::size_t count = 0, least = end_;
    while (least > 0 && count < kSome) count += count_of_[--least];
    places_.clear();
    places_.reserve(count);
    given_ = 0;
    for (std::size_t k = 0; count > 0 && k < values_.size(); ++k) {
      if (!(values_[k] > 0.0f)) continue;
      const std::size_t range = range_of(values_[k]);
      if (range >= least && range < end_) places_.push_back(k);
    }
    end_ = least;
  }

  const std::vector<float>& values_;
  std::vector<std::size_t> count_of_;  // values of each range
  std::size_t end_ = kRanges;          // ranges from here on have been gathered
  std::vector<std::size_t> places_;
  std::size_t given_ = 0;  // of them
};

// The places of a map's largest values, none nearer to another than kApart_px.
std::vector<std::size_t> peaks_of(const ErrorMap& map, int width, std::size_t most) {
  std::vector<std::size_t> peaks;
  if (most == 0) return peaks;
  const auto far_from = [&](std::size_t a, std::size_t b) {
    const auto w = static_cast<std::size_t>(width);
    const auto apart = [](std::size_t p, std::size_t q) { return p > q ? p - q : q - p; };
    return apart(a % w, b % w) >= kApart_px || apart(a / w, b / w) >= kApart_px;
  };
  WorstFirst worst_first(map.values);
  for (auto places = worst_first.next(); !places.empty(); places = worst_first.next()) {
    for (const std::size_t place : places) {
      if (!std::all_of(peaks.begin(), peaks.end(),
                       [&](std::size_t peak) { return far_from(peak, place); }))
        continue;
      peaks.push_back(place);
      if (peaks.size() == most) return peaks;
    }
  }
  return peaks;
}

}  // namespace

std::vector<WorstPixel> worst_pixels(const PicturePair& pair, const std::vector<ErrorMap>& maps,
                                     int most) {
  std::vector<const ErrorMap*> order;
  for (const bool broken : {true, false}) {
    for (const ErrorMap& map : maps) {
      if (breaks_limit(map) == broken) order.push_back(&map);
    }
  }
  const auto count = static_cast<std::size_t>(std::max(0, most));
  std::vector<std::vector<std::size_t>> peaks;
  for (const ErrorMap* map : order) peaks.push_back(peaks_of(*map, pair.width_px(), count));
  std::vector<WorstPixel> worst;
  for (std::size_t rank = 0; rank < count && worst.size() < count; ++rank) {
    for (std::size_t m = 0; m < order.size() && worst.size() < count; ++m) {
      if (rank >= peaks[m].size()) continue;
      const std::size_t k = peaks[m][rank];
      const auto width = static_cast<std::size_t>(pair.width_px());
      worst.push_back({static_cast<int>(k % width), static_cast<int>(k / width), order[m]->name,
                       double{order[m]->values[k]}, order[m]->unit,
                       numbers_at(pair.reference, order[m]->name, k),
                       numbers_at(pair.candidate, order[m]->name, k)});
    }
  }
  return worst;
}

std::int64_t pixels_over_limits(const std::vector<ErrorMap>& maps,
                                const std::function<bool(std::size_t)>& wanted) {
  std::int64_t count = 0;
  const std::size_t size = maps.empty() ? 0 : maps.front().values.size();
  for (std::size_t k = 0; k < size; ++k) {
    count += wanted(k) && std::any_of(maps.begin(), maps.end(), [&](const ErrorMap& map) {
               return map.limit && double{map.values[k]} > *map.limit;
             });
  }
  return count;
}

}  // namespace plumb::compare
