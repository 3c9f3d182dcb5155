// One stack for up to four, as the rule is written: sets, maps and whole passes, no care for speed.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "terrain/stacks/stack_field.h"

namespace plumb::test_support {

using Stacks = std::vector<std::vector<terrain::Layer>>;  // each covers [low, high], air included

class SlowAggregation {
 public:
  explicit SlowAggregation(const Stacks& stacks) {
    std::set<float> cuts;
    for (const auto& stack : stacks) {
      for (const terrain::Layer& layer : stack) cuts.insert({layer.start_m, layer.end_m});
    }
    for (auto end = std::next(cuts.begin()); end != cuts.end(); ++end) {
      Piece piece{*std::prev(end), *end, {}};
      for (const auto& stack : stacks) {
        for (const terrain::Layer& layer : stack)
          if (layer.start_m <= piece.start_m && layer.end_m >= piece.end_m)
            ++piece.count[layer.material];
      }
      pieces_.push_back(piece);
    }
    for (int k = 0; k < static_cast<int>(pieces_.size()); ++k) settle(k);
  }

  const std::vector<terrain::Layer>& layers() const { return layers_; }
  int segments() const { return static_cast<int>(pieces_.size()); }
  int by_thickness() const { return by_thickness_; }
  bool any_dominated() const {
    return std::any_of(pieces_.begin(), pieces_.end(),
                       [](const Piece& piece) { return piece.tied().size() == 1; });
  }

 private:
  struct Piece {
    float start_m, end_m;
    std::map<terrain::Material, int> count;

    std::set<terrain::Material> tied() const {
      int most = 0;
      for (const auto& [material, n] : count) most = std::max(most, n);
      std::set<terrain::Material> all;
      for (const auto& [material, n] : count)
        if (n == most) all.insert(material);
      return all;
    }
  };

  std::optional<terrain::Material> vote(int from, const std::set<terrain::Material>& tied) const {
    if (from < 0 || from >= segments()) return std::nullopt;
    const auto there = pieces_[static_cast<std::size_t>(from)].tied();
    if (there.size() != 1 || !tied.contains(*there.begin())) return std::nullopt;
    return *there.begin();
  }

  void put(float start_m, float end_m, terrain::Material material) {
    if (start_m == end_m) return;
    if (!layers_.empty() && layers_.back().material == material) {
      layers_.back().end_m = end_m;
    } else {
      layers_.push_back({start_m, end_m, material});
    }
  }

  void settle(int at) {
    const Piece& piece = pieces_[static_cast<std::size_t>(at)];
    const auto tied = piece.tied();
    if (tied.size() == 1) return put(piece.start_m, piece.end_m, *tied.begin());
    for (int w = 1; w < segments(); ++w) {
      const auto below = vote(at - w, tied), above = vote(at + w, tied);
      if (!below && !above) continue;
      const float middle_m = static_cast<float>((double{piece.start_m} + double{piece.end_m}) / 2);
      put(piece.start_m, middle_m, below ? *below : *above);
      return put(middle_m, piece.end_m, above ? *above : *below);
    }
    ++by_thickness_;
    std::map<terrain::Material, double> thickness;
    for (const Piece& other : pieces_) {
      for (const auto& [material, n] : other.count)
        thickness[material] += n * (double{other.end_m} - double{other.start_m});
    }
    const auto order = [&](terrain::Material m) {
      return std::tuple(-thickness[m], m == terrain::kAir, m);
    };
    put(piece.start_m, piece.end_m,
        *std::min_element(tied.begin(), tied.end(),
                          [&](auto a, auto b) { return order(a) < order(b); }));
  }

  std::vector<Piece> pieces_;
  std::vector<terrain::Layer> layers_;
  int by_thickness_ = 0;
};

}  // namespace plumb::test_support
