// Damaged containers: each ends in one line or in heights, never in a crash, a hang or an attempt
// to get memory that the file's size does not explain. Seeded, so that what fails fails again.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/hash.h"
#include "core/little_endian.h"
#include "core/parallel.h"
#include "mesh/patch_quadtree/coded_terrain.h"
#include "mesh/patch_quadtree/container_header.h"
#include "property/mesh/largest_request.h"
#include "support/harmed_bytes.h"
#include "support/random_scene.h"
#include "terrain/terrain_source.h"

namespace plumb::mesh::patch_quadtree {
namespace {

using test_support::harm;
using test_support::other_byte;
using test_support::Random;

constexpr CodecVersion kVersions[] = {CodecVersion::Published, CodecVersion::Modelled};

// A terrain with voids in patches of 8 cells, and something for the payload of each patch.
struct Sample {
  ContainerHeader header;
  ContainerRecords records;

  Bytes bytes() const { return container_bytes(header, records); }
};

Sample sample_of(CodecVersion version) {
  EncodedHeights encoded = encode_heights(
      terrain::load_terrain("generate:canyon?size=33&seed=5&voids=0.2", {}), {0.5, version, 8});
  Sample sample{encoded.header, {std::move(encoded.heights), {}}};
  for (std::int64_t k = 0; k < sample.header.layout.patch_count(); ++k)
    sample.records.payload.push_back(Bytes(3, static_cast<std::uint8_t>(k)));
  sample.header.parameters = {1, 2, 3};
  return sample;
}

enum class Outcome { Told, Decoded };

// Reads all that there is. Any exception but an InputError of one line fails the test, and so does
// a request of a MiB: the files have some ten KiB, the patches 121 samples.
Outcome read_all(Bytes bytes) {
  try {
    const Container container(std::move(bytes), "damaged");
    const PatchLayout& layout = container.header().layout;
    for (std::int64_t k = 0; k < layout.patch_count(); ++k) container.payload(k);
    std::atomic<std::int64_t> patches{0}, infinite{0};
    PatchDecoder(container).visit(0, [&](const PatchPlace& place, const PatchNumbers& numbers) {
      ++patches;
      const Grid<float> heights = heights_of(numbers, container.header().quantiser, place.level);
      for (const float height : heights.values()) infinite += std::isinf(height) ? 1 : 0;
    });
    EXPECT_EQ(patches, layout.patch_count());
    EXPECT_EQ(infinite, 0);
    return Outcome::Decoded;
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_NE(line.find("'damaged'"), std::string::npos) << line;
    return Outcome::Told;
  }
}

Outcome outcome_of(Bytes bytes) {
  test_support::forget_requests();
  const Outcome outcome = read_all(std::move(bytes));
  EXPECT_LT(test_support::largest_request(), std::size_t{1} << 20);
  return outcome;
}

// The file with bytes of its header at `at` (from the header's begin) replaced, and a checksum that
// says so.
Bytes with_header_bytes(Bytes file, std::size_t at, const Bytes& replaced) {
  FirstPart first;
  EXPECT_EQ(read_first_part(file, first), "");
  std::copy(replaced.begin(), replaced.end(),
            file.begin() + static_cast<std::ptrdiff_t>(kFirstBytes + at));
  first.checksum = Checksum().add_bytes(&file[kFirstBytes], first.header_bytes).value();
  const Bytes repaired = first_part(first);
  std::copy(repaired.begin(), repaired.end(), file.begin());
  return file;
}

// The same with any damage to the header.
Bytes with_harmed_header(Random& random, Bytes file) {
  FirstPart first;
  EXPECT_EQ(read_first_part(file, first), "");
  Bytes harmed;
  // Most of the header is its table, so half of the damage is for what stands before.
  const int end = random.chance(0.5) ? 100 : static_cast<int>(first.header_bytes);
  const auto at = static_cast<std::size_t>(random.integer(0, end - 1));
  const auto count = std::min<std::size_t>(static_cast<std::size_t>(random.integer(1, 4)),
                                           first.header_bytes - at);
  for (std::size_t k = 0; k < count; ++k)
    harmed.push_back(other_byte(random, file[kFirstBytes + at + k]));
  return with_header_bytes(std::move(file), at, harmed);
}

// Files so small are not worth a thread.
class ContainerFuzz : public testing::Test {
  ThreadLimit one_{1};
};

TEST_F(ContainerFuzz, TellsEveryByteThatIsChanged) {
  Random random(1);
  for (const CodecVersion version : kVersions) {
    const Bytes whole = sample_of(version).bytes();
    ASSERT_EQ(outcome_of(whole), Outcome::Decoded);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      Bytes harmed = whole;
      harmed[at] = other_byte(random, harmed[at]);
      ASSERT_EQ(outcome_of(std::move(harmed)), Outcome::Told) << "byte " << at;
    }
  }
}

TEST_F(ContainerFuzz, TellsEveryTruncation) {
  for (const CodecVersion version : kVersions) {
    const Bytes whole = sample_of(version).bytes();
    for (std::size_t size = 0; size < whole.size(); ++size)
      ASSERT_EQ(outcome_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
                Outcome::Told)
          << size << " bytes";
  }
}

TEST_F(ContainerFuzz, TellsManyBytesThatAreChanged) {
  Random random(2);
  for (const CodecVersion version : kVersions) {
    const Bytes whole = sample_of(version).bytes();
    for (int k = 0; k < 2000; ++k) {
      Bytes harmed = whole;
      harm(random, harmed);
      if (harmed == whole) continue;
      ASSERT_EQ(outcome_of(std::move(harmed)), Outcome::Told) << k;
    }
  }
}

// Checksums that agree with the damage leave it to the decoders: both outcomes occur, no other.
// Version 2 tells nearly all by the states that its coder ends in.
TEST_F(ContainerFuzz, DecodesOrTellsRecordsWhoseChecksumsAreRepaired) {
  Random random(3);
  for (const CodecVersion version : kVersions) {
    const Sample whole = sample_of(version);
    int told = 0, decoded = 0;
    for (int k = 0; k < 4000; ++k) {
      Sample harmed = whole;
      for (int records = random.integer(1, 3); records > 0; --records) {
        const int last = static_cast<int>(harmed.records.heights.size()) - 1;
        harm(random, harmed.records.heights[static_cast<std::size_t>(random.integer(0, last))]);
      }
      ++(outcome_of(harmed.bytes()) == Outcome::Told ? told : decoded);
    }
    EXPECT_GT(told, 100);
    EXPECT_GT(decoded, version == CodecVersion::Published ? 100 : 0);
  }
}

TEST_F(ContainerFuzz, DecodesOrTellsHeadersWhoseChecksumIsRepaired) {
  Random random(4);
  for (const CodecVersion version : kVersions) {
    const Bytes whole = sample_of(version).bytes();
    int told = 0, decoded = 0;
    for (int k = 0; k < 4000; ++k)
      ++(outcome_of(with_harmed_header(random, whole)) == Outcome::Told ? told : decoded);
    EXPECT_GT(told, 100);
    EXPECT_GT(decoded, 100);
  }
}

TEST_F(ContainerFuzz, DecodesOrTellsModelsWhoseChecksumIsRepaired) {
  Random random(5);
  const Sample whole = sample_of(CodecVersion::Modelled);
  int told = 0;
  for (int k = 0; k < 2000; ++k) {
    Sample harmed = whole;
    harm(random, harmed.header.models);
    told += outcome_of(harmed.bytes()) == Outcome::Told ? 1 : 0;
  }
  EXPECT_GT(told, 100);
}

// Sizes stand at the header's fourth byte, the step at its twentieth.
TEST_F(ContainerFuzz, RefusesSizesThatNoTerrainHas) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  for (const CodecVersion version : kVersions) {
    const Bytes whole = sample_of(version).bytes();
    for (const auto& [columns, rows] : {std::pair{kMost, kMost},
                                        {kMost, 33},
                                        {33, kMost},
                                        {65537, 65537},
                                        {0, 33},
                                        {33, -1},
                                        {34, 33 + 8},
                                        {1 << 20, 1 << 10}}) {
      Bytes sizes;
      put(columns, sizes);
      put(rows, sizes);
      EXPECT_EQ(outcome_of(with_header_bytes(whole, 4, sizes)), Outcome::Told)
          << columns << " x " << rows;
    }
    for (const std::int32_t cells : {0, -8, 4, 24, 2048, kMost}) {
      Bytes size;
      put(cells, size);
      EXPECT_EQ(outcome_of(with_header_bytes(whole, 12, size)), Outcome::Told) << cells;
    }
  }
}

TEST_F(ContainerFuzz, RefusesStepsThatAreNone) {
  for (const CodecVersion version : kVersions) {
    const Bytes whole = sample_of(version).bytes();
    for (const double step_m : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e38}) {
      Bytes step;
      put(step_m, step);
      EXPECT_EQ(outcome_of(with_header_bytes(whole, 20, step)), Outcome::Told) << step_m;
    }
    // The other version's rule.
    Bytes rule;
    put(version == CodecVersion::Published ? 0u : 1u, rule);
    EXPECT_EQ(outcome_of(with_header_bytes(whole, 16, rule)), Outcome::Told);
  }
}

}  // namespace
}  // namespace plumb::mesh::patch_quadtree
