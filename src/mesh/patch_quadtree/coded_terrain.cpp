#include "mesh/patch_quadtree/coded_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "mesh/patch_quadtree/published_family.h"

namespace plumb::mesh::patch_quadtree {
namespace {

ChildPlace place_in_parent(const PatchPlace& patch) {
  return {patch.px & 1, patch.py & 1, patch.level};
}

// Of contexts that occur: a bit for each, and 16 numbers of 16 bits.
Bytes model_bytes(const SymbolCounts& counts) {
  Bytes used((kModels + 7) / 8, 0), bytes;
  for (std::size_t m = 0; m < kModels; ++m) {
    const auto& symbols = counts.counts[m];
    if (std::all_of(symbols.begin(), symbols.end(), [](std::uint64_t n) { return n == 0; }))
      continue;
    used[m / 8] = static_cast<std::uint8_t>(used[m / 8] | 1u << m % 8);
    for (const std::uint16_t frequency : rans_frequencies(symbols)) {
      bytes.push_back(static_cast<std::uint8_t>(frequency));
      bytes.push_back(static_cast<std::uint8_t>(frequency >> 8));
    }
  }
  used.insert(used.end(), bytes.begin(), bytes.end());
  return used;
}

// Nothing if the bytes are no models.
std::optional<ModelTables> models_of(std::span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  const auto used = reader.bytes((kModels + 7) / 8);
  std::array<RansFrequencies, kModels> frequencies;
  frequencies.fill(rans_frequencies(std::array<std::uint64_t, kRansSymbols>{}));
  for (std::size_t m = 0; m < kModels && !reader.overrun(); ++m) {
    if ((used[m / 8] >> m % 8 & 1u) == 0) continue;
    std::uint32_t sum = 0;
    for (std::uint16_t& frequency : frequencies[m]) {
      const std::uint32_t low = reader.byte();
      frequency = static_cast<std::uint16_t>(low | std::uint32_t{reader.byte()} << 8);
      if (frequency == 0 || frequency >= kRansTotal) return std::nullopt;
      sum += frequency;
    }
    if (sum != kRansTotal) return std::nullopt;
  }
  if (reader.overrun() || !reader.rest().empty()) return std::nullopt;
  return ModelTables(frequencies);
}

class Encoder {
 public:
  Encoder(const terrain::Heightfield& field, EncodedHeights& encoded)
      : field_(field), header_(encoded.header), heights_(encoded.heights) {}

  void run() {
    const std::int64_t patches = header_.layout.patch_count();
    if (header_.version == CodecVersion::Published) {
      heights_.resize(static_cast<std::size_t>(patches) + 1);
      heights_.back() = encode_root(numbers(header_.layout.root()));
      parallel_for(patches, 1, [&](std::int64_t k) { encode_children_of(k); });
      return;
    }
    heights_.resize(static_cast<std::size_t>(patches));
    const SymbolCounts counts = all_counts(patches);
    header_.models = model_bytes(counts);
    const ModelTables tables = *models_of(header_.models);
    heights_.front() = encode_root(numbers(header_.layout.root()));
    parallel_for(patches - 1, 1, [&](std::int64_t k) {
      const PatchPlace patch = header_.layout.place(k + 1);
      heights_[static_cast<std::size_t>(k) + 1] =
          encode_child(numbers(patch.parent()), place_in_parent(patch), numbers(patch), tables);
    });
  }

 private:
  PatchNumbers numbers(const PatchPlace& patch) const {
    return numbers_of(field_.heights_m, header_.layout, patch, header_.quantiser);
  }

  SymbolCounts all_counts(std::int64_t patches) const {
    return parallel_ordered_reduce(
        patches - 1, 64, SymbolCounts{},
        [&](std::int64_t begin, std::int64_t end, SymbolCounts counts) {
          for (std::int64_t k = begin; k < end; ++k) {
            const PatchPlace patch = header_.layout.place(k + 1);
            count_symbols(numbers(patch.parent()), place_in_parent(patch), numbers(patch), counts);
          }
          return counts;
        },
        [](SymbolCounts a, const SymbolCounts& b) {
          a.add(b);
          return a;
        });
  }

  void encode_children_of(std::int64_t k) {
    const PatchPlace patch = header_.layout.place(k);
    if (patch.level == 0) return;
    Family children;
    for (int c = 0; c < 4; ++c) {
      const PatchPlace child = patch.child(c & 1, c >> 1);
      if (header_.layout.contains(child)) children[static_cast<std::size_t>(c)] = numbers(child);
    }
    heights_[static_cast<std::size_t>(k)] = encode_family(numbers(patch), children);
  }

  const terrain::Heightfield& field_;
  ContainerHeader& header_;
  std::vector<Bytes>& heights_;
};

// Every sample as the quantiser gives it back; decoding is exact, which tests hold.
void require_within(const terrain::Heightfield& field, const ContainerHeader& header) {
  const double worst = parallel_ordered_reduce(
      field.rows(), 16, 0.0,
      [&](std::int64_t begin, std::int64_t end, double most) {
        std::vector<float> buffer;
        for (std::int64_t j = begin; j < end; ++j) {
          for (const float height : field.heights_m.row(static_cast<int>(j), buffer)) {
            if (std::isnan(height)) continue;
            const Quantiser& q = header.quantiser;
            most = std::max(most, std::abs(double{q.height(q.number(height, 0), 0)} - height));
          }
        }
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
  if (worst > header.error_m)
    throw std::logic_error(
        fmt::format("a height was coded {} m off, {} m were promised", worst, header.error_m));
}

}  // namespace

EncodedHeights encode_heights(const terrain::Heightfield& field, const EncodeOptions& options) {
  terrain::require_valid(field);
  EncodedHeights encoded;
  ContainerHeader& header = encoded.header;
  header.version = options.version;
  header.layout = layout_of(field.columns(), field.rows(), options.patch_cells);
  header.quantiser = quantiser_for(
      field.heights_m, options.error_m,
      options.version == CodecVersion::Published ? StepRule::DoublesWithLevel : StepRule::Same);
  header.error_m = options.error_m;
  header.dx_m = field.dx_m;
  header.dy_m = field.dy_m;
  header.origin_m = field.origin_m;
  header.terrain_checksum = terrain::checksum(field);
  header.source = field.provenance.source;
  header.crs = field.provenance.crs;
  require_within(field, header);
  Encoder(field, encoded).run();
  return encoded;
}

PatchDecoder::PatchDecoder(const Container& container) : container_(container) {
  if (header().version == CodecVersion::Published) return;
  tables_ = models_of(header().models);
  if (!tables_) input_error("a container's models are damaged");
}

void PatchDecoder::damaged(const PatchPlace& patch) const {
  input_error("patch ({}, {}) of level {} is damaged: its bytes are no patch's", patch.px, patch.py,
              patch.level);
}

PatchNumbers PatchDecoder::root() const {
  const bool published = header().version == CodecVersion::Published;
  const Bytes bytes = container_.heights(published ? header().layout.patch_count() : 0);
  PatchNumbers numbers;
  if (!decode_root(bytes, header().layout.patch_cells, header().quantiser.rule, numbers))
    damaged(header().layout.root());
  return numbers;
}

PatchNumbers PatchDecoder::numbers(const PatchPlace& patch) const {
  require(header().layout.contains(patch), "there is no patch ({}, {}) of level {}", patch.px,
          patch.py, patch.level);
  PatchNumbers numbers_here = root();
  for (int level = header().layout.levels - 2; level >= patch.level; --level) {
    const int up = level - patch.level;
    numbers_here = numbers({level, patch.px >> up, patch.py >> up}, numbers_here);
  }
  return numbers_here;
}

PatchNumbers PatchDecoder::numbers(const PatchPlace& patch, const PatchNumbers& parent) const {
  if (tables_) {
    PatchNumbers child;
    if (!decode_child(parent, place_in_parent(patch),
                      container_.heights(header().layout.index(patch)), *tables_, child))
      damaged(patch);
    return child;
  }
  Family children;
  std::array<bool, 4> there{};
  for (int c = 0; c < 4; ++c)
    there[static_cast<std::size_t>(c)] =
        header().layout.contains(patch.parent().child(c & 1, c >> 1));
  if (!decode_family(parent, there, container_.heights(header().layout.index(patch.parent())),
                     children))
    damaged(patch);
  return std::move(*children[static_cast<std::size_t>((patch.px & 1) + 2 * (patch.py & 1))]);
}

Grid<float> PatchDecoder::heights(const PatchPlace& patch) const {
  return heights_of(numbers(patch), header().quantiser, patch.level);
}

Grid<float> PatchDecoder::level_heights(int level) const {
  const PatchLayout& layout = header().layout;
  require(level >= 0 && level < layout.levels, "a level must be in [0, {}), got {}", layout.levels,
          level);
  const auto along = [&](int samples) {
    return static_cast<int>((std::int64_t{samples} - 1 + (std::int64_t{1} << level) - 1) >> level) +
           1;
  };
  Grid<float> heights(along(layout.columns), along(layout.rows));
  std::vector<PatchNumbers> above{root()};
  for (int at = layout.levels - 1;; --at) {
    const int columns = layout.patch_columns(at);
    if (at == level) {
      parallel_for(static_cast<std::int64_t>(above.size()), 1, [&](std::int64_t k) {
        const auto px = static_cast<int>(k % columns), py = static_cast<int>(k / columns);
        const PatchNumbers& numbers_here = above[static_cast<std::size_t>(k)];
        const Grid<float> patch = heights_of(numbers_here, header().quantiser, level);
        const int n = layout.patch_cells;
        // The last sample along a side is the next patch's first, where there is one.
        for (int j = py * n; j <= std::min(py * n + n, heights.rows() - 1); ++j) {
          for (int i = px * n; i <= std::min(px * n + n, heights.columns() - 1); ++i) {
            const bool is_next = (i == px * n + n && px + 1 < columns) ||
                                 (j == py * n + n && py + 1 < layout.patch_rows(level));
            if (!is_next) heights(i, j) = patch(i - px * n + 1, j - py * n + 1);
          }
        }
      });
      return heights;
    }
    std::vector<PatchNumbers> below(static_cast<std::size_t>(layout.patch_columns(at - 1)) *
                                    static_cast<std::size_t>(layout.patch_rows(at - 1)));
    const int below_columns = layout.patch_columns(at - 1);
    parallel_for(static_cast<std::int64_t>(below.size()), 1, [&](std::int64_t k) {
      const auto px = static_cast<int>(k % below_columns), py = static_cast<int>(k / below_columns);
      below[static_cast<std::size_t>(k)] =
          numbers({at - 1, px, py},
                  above[static_cast<std::size_t>(py / 2) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(px / 2)]);
    });
    above = std::move(below);
  }
}

}  // namespace plumb::mesh::patch_quadtree
