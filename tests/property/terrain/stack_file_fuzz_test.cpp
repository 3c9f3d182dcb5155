// Files of random stacks: each comes back to the bit; damaged ones end in one line or in valid
// stacks, never in a crash, a hang or an attempt to get memory that the file's size does not
// explain. Seeded, so that what fails fails again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "core/check.h"
#include "core/hash.h"
#include "core/little_endian.h"
#include "core/parallel.h"
#include "property/mesh/largest_request.h"
#include "support/harmed_bytes.h"
#include "support/random_scene.h"
#include "terrain/stacks/stack_file.h"
#include "terrain/stacks/stack_file_header.h"

namespace plumb::terrain {
namespace {

using test_support::harm;
using test_support::other_byte;
using test_support::Random;

// A height in [-50, 200] m: anything, whole metres, or voxels.
float random_height(Random& random, int kind) {
  const double height_m = random.uniform(-50.0, 200.0);
  return static_cast<float>(kind == 0   ? height_m
                            : kind == 1 ? std::round(height_m)
                                        : std::round(height_m / 0.7) * 0.7);
}

// Anything from stacks that have nothing in common to stacks that all are alike.
StackField random_field(Random& random, int most = 24) {
  StackField field;
  field.columns = random.integer(1, most);
  field.rows = random.integer(1, most);
  field.dx_m = random.uniform(0.1, 100.0);
  field.voxel_m = random.uniform(0.5, 2.0);
  field.origin_m = {random.uniform(-1e6, 1e6), random.uniform(-1e6, 1e6)};
  field.low_m = -60.0F;
  field.voxels = 1000;
  const int materials = random.chance(0.3) ? 256 : random.integer(1, 5);
  for (int k = 0; k < materials; ++k)
    field.materials.push_back({"material" + std::to_string(k), glm::dvec3(1.0 / (k + 1))});
  const double changes = random.chance(0.3) ? 0.0 : random.uniform(0.0, 1.0),
               holes = random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.5);
  const int kind = random.integer(0, 2), most_layers = random.integer(0, 12);
  std::vector<Layer> layers;
  StackWriter writer(field);
  for (std::size_t n = 0; n < field.size(); ++n) {
    if (random.chance(changes)) {
      std::vector<float> ends;
      for (int k = random.integer(0, most_layers); k >= 0; --k)
        ends.push_back(random_height(random, kind));
      std::sort(ends.begin(), ends.end());
      layers.clear();
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        layers.push_back(
            {ends[k], ends[k + 1], static_cast<Material>(random.integer(0, materials - 1))});
    }
    random.chance(holes) ? writer.add_hole() : writer.add(layers);
  }
  return field;
}

bool same_bits(const StackField& a, const StackField& b) {
  return checksum(a) == checksum(b) && a.end_m.size() == b.end_m.size() &&
         std::memcmp(a.end_m.data(), b.end_m.data(), 4 * a.end_m.size()) == 0 &&
         a.holes == b.holes && a.materials == b.materials;
}

TEST(StackFileRandom, GivesBackEveryFieldOfAnyBlocks) {
  Random random(11);
  std::size_t layers = 0, holes = 0;
  for (int k = 0; k < 400; ++k) {
    const StackField field = random_field(random);
    layers = std::max(layers, field.end_m.size());
    holes += field.holes.empty() ? 0 : 1;
    const Bytes file = stack_file_bytes(field, random.integer(1, 30));
    ASSERT_TRUE(same_bits(stacks_of_bytes(file), field)) << k;
  }
  EXPECT_GT(layers, 1000u);
  EXPECT_GT(holes, 100u);
}

// Any float can be an end, and every material lie on every other.
TEST(StackFileRandom, GivesBackAllHeightsAndMaterials) {
  Random random(12);
  StackField field;
  field.columns = 40;
  field.rows = 10;
  field.low_m = -std::numeric_limits<float>::max();
  field.voxels = 2;
  field.voxel_m = double{std::numeric_limits<float>::max()};
  for (int k = 0; k < 256; ++k) field.materials.push_back({std::string(1, static_cast<char>(k))});
  StackWriter writer(field);
  for (std::size_t n = 0; n < field.size(); ++n) {
    std::vector<float> ends;
    for (int k = 0; k < 200; ++k) {
      const auto bits = static_cast<std::uint32_t>(random.uniform(0.0, 0x1p32));
      const auto end_m = std::bit_cast<float>(bits);
      if (std::isfinite(end_m)) ends.push_back(end_m);
    }
    std::sort(ends.begin(), ends.end());
    std::vector<Layer> layers;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      layers.push_back({ends[k], ends[k + 1], static_cast<Material>(random.integer(0, 255))});
    writer.add(layers);
  }
  EXPECT_GT(field.end_m.size(), 75000u);
  EXPECT_TRUE(same_bits(stacks_of_bytes(stack_file_bytes(field)), field));
}

TEST(StackFileRandom, HasTheSameBytesOnAnyNumberOfThreads) {
  Random random(13);
  for (int k = 0; k < 20; ++k) {
    const StackField field = random_field(random, 60);
    Bytes one, seven;
    {
      const ThreadLimit limit(1);
      one = stack_file_bytes(field, 4);
    }
    {
      const ThreadLimit limit(7);
      seven = stack_file_bytes(field, 4);
      EXPECT_TRUE(same_bits(stacks_of_bytes(one), field));
    }
    EXPECT_EQ(one, seven);
  }
}

enum class Outcome { Told, Read };

// Any exception but an InputError of one line fails the test, and so does a request of a MiB: the
// files have under ten KiB, their stacks some twenty.
Outcome outcome_of(const Bytes& file) {
  test_support::forget_requests();
  Outcome outcome = Outcome::Read;
  try {
    require_valid(stacks_of_bytes(file, "damaged"));
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_NE(line.find("'damaged'"), std::string::npos) << line;
    outcome = Outcome::Told;
  }
  EXPECT_LT(test_support::largest_request(), std::size_t{1} << 20);
  return outcome;
}

// A file of several blocks, as its parts.
struct Sample {
  StackFileHeader header;
  std::vector<Bytes> blocks;

  explicit Sample(Random& random) {
    StackField field;
    do field = random_field(random);
    while (field.end_m.size() < 100 || field.end_m.size() > 1000 || field.rows < 8);
    const Bytes file = stack_file_bytes(field, 3);
    StackFirstPart first;
    EXPECT_EQ(read_first_part(file, first), "");
    std::span<const std::uint8_t> rest = std::span(file).subspan(kStackFirstBytes);
    EXPECT_EQ(read_header(rest.first(first.header_bytes), header), "");
    rest = rest.subspan(first.header_bytes);
    for (const StackBlockEntry& entry : header.blocks) {
      blocks.emplace_back(rest.begin(), rest.begin() + entry.size);
      rest = rest.subspan(entry.size);
    }
    EXPECT_EQ(bytes(), file);
  }

  // With checksums that agree with what is there.
  Bytes bytes() const {
    StackFileHeader repaired = header;
    for (std::size_t k = 0; k < blocks.size(); ++k)
      repaired.blocks[k] = {static_cast<std::uint32_t>(blocks[k].size()),
                            static_cast<std::uint32_t>(
                                Checksum().add_bytes(blocks[k].data(), blocks[k].size()).value())};
    return bytes_with(header_bytes(repaired));
  }

  Bytes bytes_with(const Bytes& head) const {
    Bytes all = first_part_of({static_cast<std::uint32_t>(head.size()),
                               Checksum().add_bytes(head.data(), head.size()).value()});
    all.insert(all.end(), head.begin(), head.end());
    for (const Bytes& block : blocks) all.insert(all.end(), block.begin(), block.end());
    return all;
  }
};

// Files so small are not worth a thread.
class StackFileFuzz : public testing::Test {
  ThreadLimit one_{1};
};

TEST_F(StackFileFuzz, TellsEveryByteThatIsChangedAndEveryTruncation) {
  Random random(1);
  for (int k = 0; k < 3; ++k) {
    const Bytes whole = Sample(random).bytes();
    ASSERT_EQ(outcome_of(whole), Outcome::Read);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      Bytes harmed = whole;
      harmed[at] = other_byte(random, harmed[at]);
      ASSERT_EQ(outcome_of(harmed), Outcome::Told) << "byte " << at;
      harmed.resize(at);
      ASSERT_EQ(outcome_of(harmed), Outcome::Told) << at << " bytes";
    }
  }
}

// Checksums that agree with the damage leave it to the decoder, which tells most by how many bytes
// it reads; the rest is told by ends that do not rise, or is other stacks.
TEST_F(StackFileFuzz, ReadsOrTellsBlocksWhoseChecksumsAreRepaired) {
  Random random(2);
  int told = 0, read = 0;
  for (int k = 0; k < 6000; ++k) {
    Sample harmed(random);
    const int last = static_cast<int>(harmed.blocks.size()) - 1;
    Bytes& block = harmed.blocks[static_cast<std::size_t>(random.integer(0, last))];
    if (random.chance(0.5)) {
      harm(random, block);
    } else {  // late damage, which the fewest symbols follow
      const auto at = block.size() - 1 - static_cast<std::size_t>(random.integer(0, 3));
      block[at] = other_byte(random, block[at]);
    }
    ++(outcome_of(harmed.bytes()) == Outcome::Told ? told : read);
  }
  EXPECT_GT(told, 1000);
  EXPECT_GT(read, 100);
}

TEST_F(StackFileFuzz, ReadsOrTellsHeadersWhoseChecksumIsRepaired) {
  Random random(3);
  int told = 0, read = 0;
  for (int k = 0; k < 6000; ++k) {
    const Sample whole(random);
    Bytes head = header_bytes(whole.header);
    // Numbers, materials' names and colours and the table; the first and the last decide the most.
    const int from = random.chance(0.5) ? 0 : static_cast<int>(head.size()) / 2,
              to = random.chance(0.5) ? 70 : static_cast<int>(head.size());
    for (int n = random.integer(1, 4); n > 0; --n) {
      const auto at = static_cast<std::size_t>(random.integer(std::min(from, to - 1), to - 1));
      head[at] = other_byte(random, head[at]);
    }
    if (random.chance(0.1)) head.resize(static_cast<std::size_t>(random.integer(0, to)));
    ++(outcome_of(whole.bytes_with(head)) == Outcome::Told ? told : read);
  }
  EXPECT_GT(told, 1000);
  EXPECT_GT(read, 1000);
}

// Blocks of nothing but noise.
TEST_F(StackFileFuzz, TellsOrReadsNoise) {
  Random random(4);
  for (int k = 0; k < 2000; ++k) {
    Sample sample(random);
    for (Bytes& block : sample.blocks) {
      block.resize(static_cast<std::size_t>(random.integer(0, 300)));
      for (std::uint8_t& byte : block)
        byte = random.chance(0.3) ? std::uint8_t{0} : other_byte(random, 0);
    }
    outcome_of(sample.bytes());
  }
}

}  // namespace
}  // namespace plumb::terrain
