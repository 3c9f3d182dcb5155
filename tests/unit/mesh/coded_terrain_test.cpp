// Terrains through files: what comes out in another process is what went in, and damage is told.
#include "mesh/patch_quadtree/coded_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/atomic_file.h"
#include "core/check.h"
#include "core/parallel.h"
#include "support/random_scene.h"
#include "support/run_command.h"
#include "terrain/terrain_source.h"

namespace plumb::mesh::patch_quadtree {
namespace {

using test_support::Random;
using testing::TemporaryFolder;

Bytes file_of(const terrain::Heightfield& field, const EncodeOptions& options) {
  EncodedHeights encoded = encode_heights(field, options);
  const auto patches = static_cast<std::size_t>(encoded.header.layout.patch_count());
  return container_bytes(encoded.header, {std::move(encoded.heights), std::vector<Bytes>(patches)});
}

void write(const std::string& path, const Bytes& bytes) {
  write_file_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// The largest difference; infinite where a void is none, or the other way round.
double worst(const terrain::Heightfield& field, const Grid<float>& decoded) {
  double most = 0.0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      const float a = field.heights_m(i, j), b = decoded(i, j);
      if (std::isnan(a) != std::isnan(b)) return std::numeric_limits<double>::infinity();
      if (!std::isnan(a)) most = std::max(most, std::abs(double{a} - double{b}));
    }
  }
  return most;
}

TEST(CodedTerrain, KeepsItsErrorThroughAFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.plumb");
  for (const char* terrain :
       {"generate:alpine?size=257&seed=3", "generate:dunes?size=100&seed=4",
        "generate:canyon?size=129&seed=5&voids=0.2", "generate:urban?size=130&utm=1"}) {
    const terrain::Heightfield field = terrain::load_terrain(terrain, {});
    for (const CodecVersion version : {CodecVersion::Published, CodecVersion::Modelled}) {
      for (const double error_m : {0.05, 1.0, 40.0}) {
        write(path, file_of(field, {error_m, version, 32}));
        const Container container(path);
        const Grid<float> decoded = PatchDecoder(container).level_heights(0);
        ASSERT_EQ(decoded.columns(), field.columns());
        ASSERT_EQ(decoded.rows(), field.rows());
        EXPECT_LE(worst(field, decoded), error_m) << terrain;
        EXPECT_EQ(container.header().terrain_checksum, terrain::checksum(field));
        EXPECT_EQ(container.header().origin_m, field.origin_m);
      }
    }
  }
}

// A patch that is decoded alone is that of the whole level, and neighbours agree on what they
// share.
TEST(CodedTerrain, DecodesPatchesAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.plumb");
  const terrain::Heightfield field = terrain::load_terrain("generate:alpine?size=200&seed=9", {});
  for (const CodecVersion version : {CodecVersion::Published, CodecVersion::Modelled}) {
    write(path, file_of(field, {0.5, version, 16}));
    const Container container(path);
    const PatchDecoder decoder(container);
    const PatchLayout& layout = container.header().layout;
    for (int level = 0; level < layout.levels; ++level) {
      const Grid<float> all = decoder.level_heights(level);
      for (int py = 0; py < layout.patch_rows(level); ++py) {
        for (int px = 0; px < layout.patch_columns(level); ++px) {
          const Grid<float> patch = decoder.heights({level, px, py});
          for (int j = -1; j <= 17; ++j) {
            for (int i = -1; i <= 17; ++i) {
              const int x = std::clamp(px * 16 + i, 0, all.columns() - 1),
                        y = std::clamp(py * 16 + j, 0, all.rows() - 1);
              ASSERT_EQ(patch(i + 1, j + 1), all(x, y)) << level << " " << px << " " << py;
            }
          }
        }
      }
    }
  }
}

TEST(CodedTerrain, HasTheSameBytesOnAnyNumberOfThreads) {
  const terrain::Heightfield field =
      terrain::load_terrain("generate:canyon?size=300&seed=2&voids=0.1", {});
  for (const CodecVersion version : {CodecVersion::Published, CodecVersion::Modelled}) {
    const Bytes all = file_of(field, {1.0, version, 32});
    const ThreadLimit one(1);
    EXPECT_EQ(file_of(field, {1.0, version, 32}), all);
  }
}

// Whatever happens to a file ends in one line, never in anything else.
TEST(CodedTerrain, TellsDamage) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.plumb");
  const terrain::Heightfield field = terrain::load_terrain("generate:alpine?size=65&seed=6", {});
  Random random(12);
  for (const CodecVersion version : {CodecVersion::Published, CodecVersion::Modelled}) {
    const Bytes whole = file_of(field, {1.0, version, 16});
    const auto decode = [&](const Bytes& bytes) {
      write(path, bytes);
      const Container container(path);
      return PatchDecoder(container).level_heights(0);
    };
    for (int k = 0; k < 200; ++k) {
      Bytes harmed = whole;
      if (k % 3 == 0) {
        harmed.resize(
            static_cast<std::size_t>(random.integer(0, static_cast<int>(whole.size()) - 1)));
      } else {
        const auto at =
            static_cast<std::size_t>(random.integer(0, static_cast<int>(whole.size()) - 1));
        harmed[at] = static_cast<std::uint8_t>(harmed[at] ^ (1u << random.integer(0, 7)));
      }
      EXPECT_THROW(decode(harmed), InputError) << k;
    }
    Bytes longer = whole;
    longer.push_back(0);
    EXPECT_THROW(decode(longer), InputError);
    EXPECT_THROW(decode({}), InputError);
  }
  EXPECT_THROW(Container(folder.file("none.plumb")), InputError);
}

}  // namespace
}  // namespace plumb::mesh::patch_quadtree
