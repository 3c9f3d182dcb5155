#include "compare/measuring.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/distribution.h"

namespace plumb::compare {

bool Measuring::wants(const std::string& group, const char* metric) const {
  if (options.everything) return true;
  return std::any_of(profile.limits.begin(), profile.limits.end(), [&](const Limit& limit) {
    return limit.group == group && limit.metric == metric;
  });
}

bool Measuring::wants_any(const std::string& group,
                          std::initializer_list<const char*> metrics) const {
  return std::any_of(metrics.begin(), metrics.end(),
                     [&](const char* metric) { return wants(group, metric); });
}

std::vector<double> Measuring::thresholds(const std::string& group,
                                          const std::string& channel) const {
  std::vector<double> found;
  if (options.everything) found.push_back(0.0);
  for (const Limit& limit : profile.limits) {
    if (limit.group == group && limit.channel == channel && limit.threshold)
      found.push_back(*limit.threshold);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void Measuring::add(Measurement measurement) const {
  result.measurements.push_back(std::move(measurement));
}

void Measuring::add(const std::string& group, const char* metric, std::optional<double> value,
                    std::optional<std::size_t> worst_pixel) const {
  if (!wants(group, metric)) return;
  Measurement measurement{group, "", metric, {}, value};
  if (worst_pixel) {
    const auto width = static_cast<std::size_t>(pair.width_px());
    measurement.x = static_cast<int>(*worst_pixel % width);
    measurement.y = static_cast<int>(*worst_pixel / width);
  }
  add(std::move(measurement));
}

void Measuring::keep_map(ErrorMap map) const {
  if (!pair.mask.empty()) {
    for (std::size_t k = 0; k < map.values.size(); ++k) {
      if (!pair.judged(k)) map.values[k] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  result.maps.push_back(std::move(map));
}

std::optional<double> Measuring::bound(const std::string& group, const char* metric) const {
  for (const Limit& limit : profile.limits) {
    if (limit.group == group && limit.metric == metric) return limit.bound;
  }
  return std::nullopt;
}

const PlaneErrors& Measuring::errors_of(const std::string& channel) const {
  const auto found = errors.find(channel);
  if (found != errors.end()) return found->second;
  return errors[channel] = plane_errors(pair.reference.find(channel)->values,
                                        pair.candidate.find(channel)->values, pair.mask);
}

Spread spread_of(std::span<const float> values) {
  Spread spread;
  std::vector<float> finite;
  finite.reserve(values.size());
  double sum = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k])) continue;
    finite.push_back(values[k]);
    sum += double{values[k]};
    if (double{values[k]} > spread.largest) {
      spread.largest = double{values[k]};
      spread.worst = k;
    }
  }
  spread.count = finite.size();
  if (finite.empty()) return spread;
  spread.mean = sum / static_cast<double>(finite.size());
  spread.p99 = audit::distribution_of(finite).p99;
  return spread;
}

double share_of(const PicturePair& pair, std::size_t pixels) {
  const auto judged = pair.mask.empty()
                          ? static_cast<std::ptrdiff_t>(pair.size())
                          : static_cast<std::ptrdiff_t>(pair.size()) -
                                std::count(pair.mask.begin(), pair.mask.end(), std::uint8_t{0});
  return judged > 0 ? 100.0 * static_cast<double>(pixels) / static_cast<double>(judged) : 0.0;
}

}  // namespace plumb::compare
