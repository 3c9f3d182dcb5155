#include "golden_manifest.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "core/check.h"
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
tolerance = "loose.toml"
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
  EXPECT_EQ(manifest.cases[0], (GoldenCase{"one", 255, 4, "First.", "none"}));
  EXPECT_EQ(manifest.cases[1], (GoldenCase{"two_2", 255, 10, "Second.", "loose.toml"}));
  EXPECT_TRUE(manifest.cases[0].bit_for_bit());
  EXPECT_FALSE(manifest.cases[1].bit_for_bit());
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
  const std::string text = with_case(manifest, {"three", 7, 0, "Says \"why\".", "default"});
  EXPECT_EQ(text.rfind(kTwo, 0), 0u);
  const GoldenManifest longer = parse_manifest(text, "g");
  ASSERT_EQ(longer.cases.size(), 3u);
  EXPECT_EQ(longer.cases[2].checksum, 7u);
  EXPECT_EQ(longer.cases[2].why, "Says \"why\".");
  EXPECT_EQ(longer.cases[2].tolerance, "default");
  EXPECT_EQ(parse_manifest(with_case(parse_manifest("", "g"), {"a", 1, 0, "b", "none"}), "g")
                .cases.size(),
            1u);
}

TEST(GoldenManifest, RefusesNamesThatAreNoFolderOfItsOwn) {
  const GoldenManifest manifest = parse_manifest(kTwo, "g");
  const auto add = [&](const char* name, const char* why) {
    return with_case(manifest, {name, 7, 0, why, "none"});
  };
  for (const char* name : {"one", "../one", "", ".", "..", ".one", "-o", "a/b", "manifest.toml"})
    EXPECT_THROW(add(name, "A reason."), InputError) << name;
  for (const char* name : {"One", "frame-02", "frame.0001", "_"}) EXPECT_NO_THROW(add(name, "A."));
  EXPECT_THROW(add("three", ""), InputError);
  EXPECT_THROW(add("three", "two\nlines"), InputError);
}

TEST(GoldenManifest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(
      error_of("[[case]]\nnam = \"a\"\n"),
      "g/manifest.toml, line 2: case.nam: unknown key; a case has name, checksum, tolerance, why");
  EXPECT_EQ(error_of("[cases]\n"),
            "g/manifest.toml, line 1: cases: unknown key; a manifest has case");
  EXPECT_EQ(error_of("[[case]]\nchecksum = \"12\"\n"),
            "g/manifest.toml, line 2: case.checksum: expected sixteen hexadecimal digits");
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

using Names = std::vector<std::string>;

TEST(GoldenManifest, WantsNothingElseInItsFolder) {
  const testing::TemporaryFolder folder;
  for (const char* file : {"manifest.toml", "one/ref/picture.exr", "two_2/ref/picture.PNG"})
    touch(folder.path() / file);
  const GoldenManifest manifest = parse_manifest(kTwo, folder.path());
  EXPECT_EQ(stray_files(manifest), Names{});
  for (const char* stray : {"three/scene.toml", "one/notes.txt", "one/ref/old.exr", "a.png"})
    touch(folder.path() / stray);
  EXPECT_EQ(stray_files(manifest), (Names{"a.png", "one/notes.txt", "one/ref/old.exr", "three"}));
}

// A preview belongs to what plumb draws; else the picture is the reference, and one of two is over.
TEST(GoldenManifest, KnowsTheReferenceOfEitherKindOfCase) {
  const testing::TemporaryFolder folder;
  const GoldenManifest manifest = parse_manifest(kTwo, folder.path());
  EXPECT_TRUE(manifest.references("one").empty());
  for (const char* file : {"one/scene.toml", "one/ref/picture.exr", "one/ref/picture.png",
                           "two_2/ref/picture.tif", "two_2/ref/picture.png", "two_2/ref/a.png"})
    touch(folder.path() / file);
  EXPECT_TRUE(manifest.is_drawn("one"));
  EXPECT_FALSE(manifest.is_drawn("two_2"));
  EXPECT_EQ(manifest.references("one").size(), 1u);
  EXPECT_EQ(manifest.references("two_2").size(), 2u);
}

TEST(GoldenManifest, FindsProfilesInItsFolderAndKnowsWhatTheyInherit) {
  const testing::TemporaryFolder folder;
  touch(folder.path() / "manifest.toml");
  const GoldenManifest manifest = parse_manifest(kTwo, folder.path());
  EXPECT_THROW(profile_of(manifest, manifest.cases[1]), InputError);
  std::ofstream(folder.path() / "loose.toml") << "inherits = \"base.toml\"\n";
  std::ofstream(folder.path() / "base.toml") << "[colour]\nlargest = 0.125\n";
  std::ofstream(folder.path() / "unused.toml") << "[colour]\nlargest = 0.25\n";
  const compare::Profile profile = profile_of(manifest, manifest.cases[1]);
  ASSERT_EQ(profile.limits.size(), 1u);
  EXPECT_EQ(profile.limits[0].bound, 0.125);
  EXPECT_EQ(profile_of(manifest, manifest.cases[0]), compare::built_in_profiles().front());
  EXPECT_EQ(stray_files(manifest), Names{"unused.toml"});
}

}  // namespace
}  // namespace plumb::tool
