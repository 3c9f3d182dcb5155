// Things sorted into bands, in parallel: each band's own, in the order of their indices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/memory.h"
#include "core/parallel.h"

namespace plumb::audit {

/// Lists of indices, a list for each band.
class BandLists {
 public:
  /// bands_of(index, visit) calls visit(band) for each band that holds the thing, ascending; it is
  /// asked twice. Throws InputError, naming `what`, if the lists do not fit into memory.
  template <class BandsOf>
  BandLists(std::size_t count, std::size_t bands, const BandsOf& bands_of, std::string_view what)
      : start_(bands + 1) {
    // Pieces count for themselves, then each knows where in a band its own begin.
    constexpr std::size_t kPiece = 1 << 16;
    std::vector<std::vector<std::size_t>> counts((count + kPiece - 1) / kPiece);
    const auto for_each_piece = [&](const auto& visit) {
      parallel_for(static_cast<std::int64_t>(counts.size()), 1, [&](std::int64_t at) {
        const auto piece = static_cast<std::size_t>(at);
        counts[piece].resize(bands);
        for (std::size_t k = piece * kPiece; k < std::min((piece + 1) * kPiece, count); ++k) {
          const auto index = static_cast<std::uint32_t>(k);
          bands_of(index,
                   [&](int band) { visit(counts[piece][static_cast<std::size_t>(band)], index); });
        }
      });
    };
    for_each_piece([](std::size_t& own, std::uint32_t) { ++own; });
    std::size_t next = 0;
    for (std::size_t band = 0; band < bands; ++band) {
      start_[band] = next;
      for (auto& own : counts) next += std::exchange(own[band], next);
    }
    start_.back() = next;
    require_memory(static_cast<std::int64_t>(next * sizeof(std::uint32_t)), what);
    indices_.resize(next);
    for_each_piece([&](std::size_t& own, std::uint32_t index) { indices_[own++] = index; });
  }

  std::size_t bands() const { return start_.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t band) const {
    return {indices_.data() + start_[band], start_[band + 1] - start_[band]};
  }

 private:
  std::vector<std::size_t> start_;  // of each band; one more at the end
  std::vector<std::uint32_t> indices_;
};

}  // namespace plumb::audit
