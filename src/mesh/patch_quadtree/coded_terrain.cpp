#include "mesh/patch_quadtree/coded_terrain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "mesh/patch_quadtree/container_header.h"
#include "mesh/patch_quadtree/modelled_patch.h"
#include "mesh/patch_quadtree/published_family.h"
#include "mesh/patch_quadtree/rans_models.h"

namespace plumb::mesh::patch_quadtree {
namespace {

ChildPlace place_in_parent(const PatchPlace& patch) {
  return {patch.px & 1, patch.py & 1, patch.level};
}

class Encoder {
 public:
  Encoder(const terrain::HeightGrid& heights_m, EncodedHeights& encoded)
      : heights_m_(heights_m), header_(encoded.header), heights_(encoded.heights) {}

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
    header_.models = rans_model_bytes(counts.counts);
    const ModelTables tables{*rans_tables_of(header_.models, kModels)};
    heights_.front() = encode_root(numbers(header_.layout.root()));
    parallel_for(patches - 1, 1, [&](std::int64_t k) {
      const PatchPlace patch = header_.layout.place(k + 1);
      heights_[static_cast<std::size_t>(k) + 1] =
          encode_child(numbers(patch.parent()), place_in_parent(patch), numbers(patch), tables);
    });
  }

 private:
  PatchNumbers numbers(const PatchPlace& patch) const {
    return numbers_of(heights_m_, header_.layout, patch, header_.quantiser);
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

  const terrain::HeightGrid& heights_m_;
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
  header.crs = terrain::system_of_coordinates(field.provenance);
  if (const std::string why = wrong_with(header); !why.empty())
    input_error("{} within {:g} m cannot be coded: {}", header.source, header.error_m, why);
  require_within(field, header);
  Encoder(field.heights_m, encoded).run();
  return encoded;
}

}  // namespace plumb::mesh::patch_quadtree
