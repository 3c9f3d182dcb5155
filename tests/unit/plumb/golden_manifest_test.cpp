#include "golden_manifest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/check.h"
#include "golden_picture.h"
#include "support/run_command.h"

namespace plumb::tool {
namespace {

constexpr const char* kTwo = R"(# kept
[[case]]
name = "one"
checksum = "00000000000000ff"  # a remark
tolerance = "none"
why = "First."

[[case]]
name = "two_2"
checksum = "00000000000000ff"
tolerance = "none"
why = "Second."
)";

std::string error_of(const std::string& text) {
  try {
    parse_manifest(text, "g");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(GoldenManifest, GivesItsCasesInOrder) {
  const GoldenManifest manifest = parse_manifest(kTwo, "g");
  ASSERT_EQ(manifest.cases.size(), 2u);
  EXPECT_EQ(manifest.cases[0], (GoldenCase{"one", 255, 4, "First."}));
  EXPECT_EQ(manifest.cases[1], (GoldenCase{"two_2", 255, 10, "Second."}));
  EXPECT_EQ(manifest.exr("one"), "g/one/ref/picture.exr");
  EXPECT_EQ(find_case(manifest, "two_2").checksum_line, 10);
  EXPECT_THROW(find_case(manifest, "three"), InputError);
}

TEST(GoldenManifest, ChangesOneChecksumAndNothingElse) {
  const GoldenManifest manifest = parse_manifest(kTwo, "g");
  std::string expected = kTwo;
  expected.replace(expected.rfind("00000000000000ff"), 16, "0123456789abcdef");
  EXPECT_EQ(with_checksum(manifest, "two_2", 0x0123456789abcdefULL), expected);
}

TEST(GoldenManifest, GetsACaseMoreAtItsEnd) {
  const GoldenManifest manifest = parse_manifest(kTwo, "g");
  const std::string text = with_case(manifest, {"three", 7, 0, "Says \"why\"."});
  EXPECT_EQ(text.rfind(kTwo, 0), 0u);
  const GoldenManifest longer = parse_manifest(text, "g");
  ASSERT_EQ(longer.cases.size(), 3u);
  EXPECT_EQ(longer.cases[2].checksum, 7u);
  EXPECT_EQ(longer.cases[2].why, "Says \"why\".");
  EXPECT_EQ(parse_manifest(with_case(parse_manifest("", "g"), {"a", 1, 0, "b"}), "g").cases.size(),
            1u);
}

TEST(GoldenManifest, RefusesNamesThatAreNoFolderOfItsOwn) {
  const GoldenManifest manifest = parse_manifest(kTwo, "g");
  EXPECT_THROW(with_case(manifest, {"one", 7, 0, "Again."}), InputError);
  EXPECT_THROW(with_case(manifest, {"../one", 7, 0, "Out."}), InputError);
  EXPECT_THROW(with_case(manifest, {"", 7, 0, "No name."}), InputError);
  EXPECT_THROW(with_case(manifest, {"three", 7, 0, ""}), InputError);
  EXPECT_THROW(with_case(manifest, {"three", 7, 0, "two\nlines"}), InputError);
}

TEST(GoldenManifest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(
      error_of("[[case]]\nnam = \"a\"\n"),
      "g/manifest.toml, line 2: case.nam: unknown key; a case has name, checksum, tolerance, why");
  EXPECT_EQ(error_of("[cases]\n"),
            "g/manifest.toml, line 1: cases: unknown key; a manifest has case");
  EXPECT_EQ(error_of("[[case]]\nchecksum = \"12\"\n"),
            "g/manifest.toml, line 2: case.checksum: expected sixteen hexadecimal digits");
  EXPECT_EQ(error_of("[[case]]\ntolerance = \"1px\"\n"),
            "g/manifest.toml, line 2: case.tolerance: expected \"none\", bit for bit");
  EXPECT_EQ(error_of("[[case]]\nname = \"a\"\n"),
            "g/manifest.toml, line 1: case: a case needs checksum, tolerance, why");
  EXPECT_EQ(error_of("[case]\nname = \"a\"\n"),
            "g/manifest.toml, line 1: case: expected tables, each under its own [[...]]");
  const std::string twice = std::string(kTwo) + kTwo;
  EXPECT_NE(error_of(twice).find("a second case 'one'"), std::string::npos);
}

void touch(const std::filesystem::path& path) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << "x";
}

TEST(GoldenManifest, WantsNothingElseInItsFolder) {
  const testing::TemporaryFolder folder;
  touch(folder.path() / "manifest.toml");
  touch(folder.path() / "one" / "ref" / "picture.exr");
  const GoldenManifest manifest = parse_manifest(kTwo, folder.path());
  EXPECT_NO_THROW(require_tidy(manifest));
  for (const char* stray : {"three/scene.toml", "one/notes.txt", "one/ref/old.exr", "a.png"}) {
    touch(folder.path() / stray);
    EXPECT_THROW(require_tidy(manifest), InputError) << stray;
    std::filesystem::remove_all(folder.path() /
                                (std::string(stray) == "three/scene.toml" ? "three" : stray));
  }
  EXPECT_NO_THROW(require_tidy(manifest));
}

image::AovImage grey(int width, int height) {
  image::AovImage image;
  image.width_px = width;
  image.height_px = height;
  for (const image::Channel& channel : image::channels())
    (image.*channel.values).assign(image.size(), 0.5f);
  return image;
}

TEST(ChannelDifferences, CountPixelsByTheirBits) {
  const image::AovImage a = grey(4, 3);
  image::AovImage b = a;
  EXPECT_TRUE(channel_differences(a, b).empty());
  b.z[2] = 0.75f;
  b.z[3] = 1.5f;
  b.nx[5] = std::numeric_limits<float>::infinity();
  const auto found = channel_differences(a, b);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].channel, "Z");
  EXPECT_EQ(found[0].pixels, 2);
  EXPECT_EQ(found[0].largest, 1.0);
  EXPECT_EQ(found[1].channel, "N.X");
  EXPECT_TRUE(std::isinf(found[1].largest));
}

TEST(ChannelDifferences, TellZeroFromMinusZeroAndNanFromItself) {
  image::AovImage a = grey(1, 1), b = a;
  a.r[0] = 0.0f;
  b.r[0] = -0.0f;
  a.g[0] = b.g[0] = std::numeric_limits<float>::quiet_NaN();
  const auto found = channel_differences(a, b);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].channel, "R");
  EXPECT_EQ(found[0].largest, 0.0);
}

TEST(ChannelDifferences, CountAMissingChannelWhole) {
  const image::AovImage a = grey(4, 3);
  image::AovImage b = a;
  b.overdraw.clear();
  const auto found = channel_differences(a, b);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].channel, "overdraw");
  EXPECT_EQ(found[0].pixels, 12);
  EXPECT_THROW(channel_differences(a, grey(3, 4)), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::tool
