#include "compare/worst_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

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

// The places of a map's largest values, none nearer to another than kApart_px.
std::vector<std::size_t> peaks_of(const ErrorMap& map, int width, std::size_t most) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < map.values.size(); ++k) {
    if (map.values[k] > 0.0f) order.push_back(k);
  }
  const auto worse = [&](std::size_t a, std::size_t b) {
    return map.values[a] != map.values[b] ? map.values[a] > map.values[b] : a < b;
  };
  std::vector<std::size_t> peaks;
  const auto far_from = [&](std::size_t a, std::size_t b) {
    const auto w = static_cast<std::size_t>(width);
    const auto apart = [](std::size_t p, std::size_t q) { return p > q ? p - q : q - p; };
    return apart(a % w, b % w) >= kApart_px || apart(a / w, b / w) >= kApart_px;
  };
  // Each round sorts the worst that are left; a round is enough but where one defect fills it.
  std::size_t begin = 0;
  while (peaks.size() < most && begin < order.size()) {
    const std::size_t end = std::min(order.size(), begin + 4096);
    std::partial_sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                      order.begin() + static_cast<std::ptrdiff_t>(end), order.end(), worse);
    for (std::size_t at = begin; at < end && peaks.size() < most; ++at) {
      if (std::all_of(peaks.begin(), peaks.end(),
                      [&](std::size_t peak) { return far_from(peak, order[at]); }))
        peaks.push_back(order[at]);
    }
    begin = end;
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
