#include "mesh/patch_quadtree/modelled_patch.h"

#include <algorithm>
#include <cstddef>

#include "mesh/patch_quadtree/void_mask.h"

namespace plumb::mesh::patch_quadtree {
namespace {

constexpr std::uint8_t kEscape = kRansSymbols - 1;
enum Flags : std::uint8_t { NoVoids = 0, SomeVoids = 1, AllVoid = 2 };

std::size_t group_of(int level) {
  return static_cast<std::size_t>(std::min(level, kLevelGroups - 1));
}

std::size_t first_model(int level, int kind) {
  return (group_of(level) * kSampleKinds + static_cast<std::size_t>(kind)) * kContexts;
}

// The side on which the truth lies rather comes first.
std::uint32_t folded_towards(std::int32_t d, bool below) { return folded(below ? -d : d); }
std::int32_t unfolded_towards(std::uint32_t number, bool below) {
  return below ? -unfolded(number) : unfolded(number);
}

std::int32_t nearest(std::int32_t value) { return (value + 32) >> 6; }
bool is_below(std::int32_t value) { return value < nearest(value) * 64; }

// Marks of the samples of a row; none where the patch has no voids.
using Marks = std::span<const std::uint8_t>;

// Numbers of voids are those of what is beside them, so that they disturb no foretelling: along the
// rows first, then whole rows from the row below or above.
void fill_voids(const Grid<std::uint8_t>& voids, Grid<std::int32_t>& numbers) {
  int filled = -1;  // the last row that is not all void
  for (int j = 0; j < numbers.rows(); ++j) {
    const auto marks = voids.row(j);
    const auto row = numbers.row(j);
    const auto first = std::find(marks.begin(), marks.end(), std::uint8_t{0});
    if (first == marks.end()) {
      if (filled >= 0) std::copy_n(numbers.row(filled).begin(), row.size(), row.begin());
      continue;
    }
    std::int32_t last = row[static_cast<std::size_t>(first - marks.begin())];
    for (std::size_t i = 0; i < row.size(); ++i) last = row[i] = marks[i] != 0 ? last : row[i];
    for (int above = j - 1; filled < 0 && above >= 0; --above)
      std::copy_n(row.begin(), row.size(), numbers.row(above).begin());
    filled = j;
  }
  if (filled < 0) std::fill(numbers.values().begin(), numbers.values().end(), 0);
}

// The voids of a child's samples by their parity, the rim repeated as ChildSamples does; empty
// grids where there are none.
struct ChildVoids {
  Grid<std::uint8_t> known, centre, across, up;

  bool empty() const { return centre.empty(); }
};

// The same bookkeeping for marks as for numbers.
Grid<std::int32_t> widened(const Grid<std::uint8_t>& marks) {
  Grid<std::int32_t> wide(marks.columns(), marks.rows());
  std::copy(marks.values().begin(), marks.values().end(), wide.values().begin());
  return wide;
}
Grid<std::uint8_t> narrowed(const Grid<std::int32_t>& marks) {
  Grid<std::uint8_t> narrow(marks.columns(), marks.rows());
  std::transform(marks.values().begin(), marks.values().end(), narrow.values().begin(),
                 [](std::int32_t mark) { return static_cast<std::uint8_t>(mark); });
  return narrow;
}

ChildVoids child_voids(const PatchNumbers& parent, const ChildPlace& place, int n,
                       const Grid<std::uint8_t>& child) {
  if (child.empty() && !parent.has_voids()) return {};
  ChildSamples marks(n);
  if (parent.has_voids()) marks.set_known(widened(parent.voids), place.s, place.t);
  if (!child.empty()) marks.split(widened(child));
  marks.repeat_rim_of_centres();
  return {narrowed(marks.known), narrowed(marks.centre), narrowed(marks.across),
          narrowed(marks.up)};
}

// Visits every sample of the child that its parent does not have, class by class, row by row:
// code(first model, foretold, marks, row of numbers) writes or reads the row.
template <class Code>
void visit(const ChildPlace& place, const ChildVoids& voids, ChildSamples& samples,
           const Code& code) {
  constexpr int kOff = 2;
  const int half = samples.n / 2;
  Foretold row;
  const auto marks_of = [&](const Grid<std::uint8_t>& of, int b, int from) {
    return voids.empty() ? Marks{}
                         : Marks(of.row(b + kOff)).subspan(static_cast<std::size_t>(from + kOff));
  };
  const auto numbers_of_row = [&](Grid<std::int32_t>& of, int b, int from) {
    return of.row(b + kOff).subspan(static_cast<std::size_t>(from + kOff), row.value.size());
  };
  if (!voids.empty()) fill_voids(voids.known, samples.known);
  for (int b = -1; b <= half; ++b) {
    foretell_centres(samples, b, row);
    code(first_model(place.level, 0), row, marks_of(voids.centre, b, -1),
         numbers_of_row(samples.centre, b, -1));
  }
  samples.repeat_rim_of_centres();
  if (!voids.empty()) fill_voids(voids.centre, samples.centre);
  for (int b = 0; b <= half; ++b) {
    foretell_across(samples, b, row);
    code(first_model(place.level, 1), row, marks_of(voids.across, b, -1),
         numbers_of_row(samples.across, b, -1));
  }
  for (int b = -1; b <= half; ++b) {
    foretell_up(samples, b, row);
    code(first_model(place.level, 1), row, marks_of(voids.up, b, 0),
         numbers_of_row(samples.up, b, 0));
  }
}

bool is_void(Marks marks, std::size_t k) { return !marks.empty() && marks[k] != 0; }

// put(model, symbol number from zero) of every sample that has a height.
template <class Put>
void visit_symbols(const PatchNumbers& parent, const ChildPlace& place, const PatchNumbers& child,
                   const Put& put) {
  const int n = child.q.columns() - 3;
  ChildSamples samples(n);
  samples.set_known(parent.q, place.s, place.t);
  samples.split(child.q);
  const ChildVoids voids = child_voids(parent, place, n, child.voids);
  visit(place, voids, samples,
        [&](std::size_t first, const Foretold& row, Marks marks, std::span<std::int32_t> numbers) {
          for (std::size_t k = 0; k < numbers.size(); ++k) {
            const std::int32_t p = row.value[k];
            if (is_void(marks, k)) {
              numbers[k] = nearest(p);
            } else {
              put(first + row.context[k], folded_towards(numbers[k] - nearest(p), is_below(p)));
            }
          }
        });
}

bool all_void(const PatchNumbers& numbers) {
  return numbers.has_voids() &&
         std::find(numbers.voids.values().begin(), numbers.voids.values().end(), 0) ==
             numbers.voids.values().end();
}

void clear_voids(PatchNumbers& numbers) {
  for (std::size_t k = 0; numbers.has_voids() && k < numbers.q.size(); ++k) {
    if (numbers.voids.values()[k] != 0) numbers.q.values()[k] = 0;
  }
}

}  // namespace

void SymbolCounts::add(const SymbolCounts& other) {
  for (std::size_t m = 0; m < kModels; ++m) {
    for (std::size_t k = 0; k < counts[m].size(); ++k) counts[m][k] += other.counts[m][k];
  }
}

void count_symbols(const PatchNumbers& parent, const ChildPlace& place, const PatchNumbers& child,
                   SymbolCounts& counts) {
  visit_symbols(parent, place, child, [&](std::size_t model, std::uint32_t number) {
    ++counts.counts[model][std::min<std::uint32_t>(number, kEscape)];
  });
}

Bytes encode_child(const PatchNumbers& parent, const ChildPlace& place, const PatchNumbers& child,
                   const ModelTables& tables) {
  Bytes bytes;
  bytes.push_back(!child.has_voids() ? NoVoids : all_void(child) ? AllVoid : SomeVoids);
  if (bytes.front() == AllVoid) return bytes;
  const int n = child.q.columns() - 3;
  if (child.has_voids())
    put_part(encode_voids(child.voids, known_voids(parent.voids, place.s, place.t, n)), bytes);
  std::vector<RansSymbol> symbols;
  GammaWriter escapes;
  visit_symbols(parent, place, child, [&](std::size_t model, std::uint32_t number) {
    const std::uint32_t symbol = std::min<std::uint32_t>(number, kEscape);
    symbols.push_back({&tables.tables[model], static_cast<std::uint8_t>(symbol)});
    if (symbol == kEscape) escapes.put(number - kEscape + 1);
  });
  put_part(escapes.bytes(), bytes);
  const Bytes coded = rans_encode(symbols);
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  return bytes;
}

bool decode_child(const PatchNumbers& parent, const ChildPlace& place,
                  std::span<const std::uint8_t> bytes, const ModelTables& tables,
                  PatchNumbers& child) {
  const int side = parent.q.columns(), n = side - 3;
  ByteReader reader(bytes);
  const std::uint8_t flags = reader.byte();
  child.voids = {};
  if (flags > AllVoid) return false;
  if (flags == AllVoid) {
    child.q = Grid<std::int32_t>(side, side);
    child.voids = Grid<std::uint8_t>(side, side, 1);
    return bytes.size() == 1;
  }
  if (flags == SomeVoids &&
      !decode_voids(reader.bytes(reader.number()), known_voids(parent.voids, place.s, place.t, n),
                    child.voids))
    return false;
  GammaReader escapes(reader.bytes(reader.number()));
  RansDecoder decoder(reader.rest());
  ChildSamples samples(n);
  samples.set_known(parent.q, place.s, place.t);
  const ChildVoids voids = child_voids(parent, place, n, child.voids);
  std::vector<std::uint8_t> symbols, contexts;
  visit(place, voids, samples,
        [&](std::size_t first, const Foretold& row, Marks marks, std::span<std::int32_t> numbers) {
          const std::span<const RansTable> models(&tables.tables[first], kContexts);
          symbols.resize(numbers.size());
          if (marks.empty()) {
            decoder.take(models, row.context, symbols);
          } else {
            for (std::size_t k = 0; k < numbers.size(); ++k)
              symbols[k] = is_void(marks, k)
                               ? std::uint8_t{0}
                               : static_cast<std::uint8_t>(decoder.take(models[row.context[k]]));
          }
          for (std::size_t k = 0; k < numbers.size(); ++k) {
            const std::int32_t p = row.value[k];
            const std::uint32_t number =
                symbols[k] < kEscape ? symbols[k] : kEscape - 1 + escapes.take();
            numbers[k] =
                is_void(marks, k)
                    ? nearest(p)
                    : as_number(std::int64_t{nearest(p)} + unfolded_towards(number, is_below(p)),
                                StepRule::Same);
          }
        });
  child.q = samples.joined();
  clear_voids(child);
  return decoder.is_finished() && !escapes.overrun() && !reader.overrun();
}

}  // namespace plumb::mesh::patch_quadtree
