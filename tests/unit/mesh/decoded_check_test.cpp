// What a container gives back is compared with the terrain, patch by patch.
#include "mesh/patch_quadtree/decoded_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>

#include "core/parallel.h"
#include "mesh/patch_quadtree/coded_terrain.h"
#include "terrain/terrain_source.h"

namespace plumb::mesh::patch_quadtree {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

Container coded(const terrain::Heightfield& field, const EncodeOptions& options) {
  EncodedHeights encoded = encode_heights(field, options);
  const auto patches = static_cast<std::size_t>(encoded.header.layout.patch_count());
  return Container(
      container_bytes(encoded.header, {std::move(encoded.heights), std::vector<Bytes>(patches)}));
}

terrain::Heightfield flat() {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(9, 9, 0.0f);
  return field;
}

TEST(DecodedCheck, HoldsOnEveryLevelOfBothVersions) {
  const terrain::Heightfield field =
      terrain::load_terrain("generate:canyon?size=150&seed=5&voids=0.2", {});
  for (const CodecVersion version : {CodecVersion::Published, CodecVersion::Modelled}) {
    const Container container = coded(field, {0.7, version, 16});
    const std::vector<DecodedLevel> levels = check_decoded(container, field);
    ASSERT_EQ(levels.size(), 5u);  // 10 x 10 patches, 5 x 5, 3 x 3, 2 x 2, 1
    EXPECT_EQ(levels[0].patches, 100);
    EXPECT_EQ(levels[2].patches, 9);
    for (const DecodedLevel& level : levels) {
      EXPECT_TRUE(level.holds());
      EXPECT_EQ(level.samples, level.patches * 19 * 19);
      EXPECT_GT(level.voids, 0);
      EXPECT_GT(level.largest_error_m, 0.5 * level.promised_m);  // it was looked for
    }
    EXPECT_EQ(levels[0].promised_m, 0.7);
    EXPECT_EQ(levels[2].promised_m, version == CodecVersion::Published ? 4 * 0.7 : 0.7);
    EXPECT_NO_THROW(require_holds(levels));
  }
}

// Nine samples a side are one patch of eight cells.
TEST(DecodedCheck, FindsTheOneHeightThatIsOff) {
  const Container container = coded(flat(), {1.0, CodecVersion::Modelled, 8});
  terrain::Heightfield other = flat();
  other.heights_m.floats()(4, 4) = 100.0f;
  const std::vector<DecodedLevel> levels = check_decoded(container, other);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].largest_error_m, 100.0);
  EXPECT_FALSE(levels[0].holds());
  EXPECT_THROW(require_holds(levels), std::logic_error);
}

// A corner stands at four places of the margin's grid: its own, beside, below and across.
TEST(DecodedCheck, FindsTheOneVoidThatDiffers) {
  const Container container = coded(flat(), {1.0, CodecVersion::Published, 8});
  terrain::Heightfield other = flat();
  other.heights_m.floats()(0, 0) = kVoid;
  const std::vector<DecodedLevel> levels = check_decoded(container, other);
  EXPECT_EQ(levels[0].voids_differ, 4);
  EXPECT_EQ(levels[0].voids, 0);
  EXPECT_EQ(levels[0].largest_error_m, 0.0);
  EXPECT_THROW(require_holds(levels), std::logic_error);
}

TEST(DecodedCheck, RefusesATerrainOfAnotherSize) {
  const Container container = coded(flat(), {1.0, CodecVersion::Modelled, 8});
  terrain::Heightfield other;
  other.heights_m = Grid<float>(9, 10, 0.0f);
  EXPECT_THROW(check_decoded(container, other), std::invalid_argument);
}

TEST(PatchDecoder, VisitsEveryPatchOnceWithItsNumbers) {
  const terrain::Heightfield field =
      terrain::load_terrain("generate:canyon?size=200&seed=8&voids=0.1", {});
  for (const CodecVersion version : {CodecVersion::Published, CodecVersion::Modelled}) {
    const Container container = coded(field, {1.0, version, 8});
    const PatchDecoder decoder(container);
    const PatchLayout& layout = container.header().layout;
    for (const int level : {0, 2, layout.levels - 1}) {
      std::mutex mutex;
      std::multiset<std::int64_t> visited;
      decoder.visit(level, [&](const PatchPlace& place, const PatchNumbers& numbers) {
        const PatchNumbers alone = decoder.numbers(place);
        const std::lock_guard lock(mutex);
        visited.insert(layout.index(place));
        EXPECT_EQ(numbers.q, alone.q);
        EXPECT_EQ(numbers.voids, alone.voids);
      });
      ASSERT_EQ(static_cast<std::int64_t>(visited.size()), layout.first_of_level(level - 1));
      EXPECT_EQ(std::set<std::int64_t>(visited.begin(), visited.end()).size(), visited.size());
    }
    EXPECT_THROW(decoder.visit(-1, {}), std::invalid_argument);
    EXPECT_THROW(decoder.visit(layout.levels, {}), std::invalid_argument);
    const PatchNumbers root = decoder.numbers(layout.root());
    const Family children = decoder.children(layout.root(), root);
    for (int c = 0; c < 4; ++c) {
      const PatchPlace child = layout.root().child(c & 1, c >> 1);
      EXPECT_EQ(children[static_cast<std::size_t>(c)]->q, decoder.numbers(child, root).q);
    }
  }
}

TEST(PatchDecoder, NamesTheFileWhoseRecordIsNoPatch) {
  EncodedHeights encoded = encode_heights(flat(), {1.0, CodecVersion::Modelled, 8});
  encoded.heights[0] = {7};
  const Container container(container_bytes(encoded.header, {encoded.heights, {Bytes{}}}), "mine");
  try {
    PatchDecoder(container).level_heights(0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "cannot read 'mine': patch (0, 0) of level 0 is damaged, its bytes are no patch's");
  }
}

}  // namespace
}  // namespace plumb::mesh::patch_quadtree
