// Profiles by name, in a file and in a line; and what a method makes of them.
#include "audit/profile_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "audit/method.h"
#include "core/check.h"

namespace plumb::audit {
namespace {

namespace fs = std::filesystem;

class ProfileFile : public testing::Test {
 protected:
  ProfileFile()
      : path_((fs::temp_directory_path() /
               (std::string("plumb_profile_") +
                testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml"))
                  .string()) {}
  ~ProfileFile() override { fs::remove(path_); }
  const std::string& write(const std::string& text) const {
    std::ofstream(path_) << text;
    return path_;
  }
  std::string error_of(const std::string& text) const {
    try {
      parse_profile(write(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::string path_;
};

TEST_F(ProfileFile, IsReadAsItWasWritten) {
  const slicing::CostProfile profile{"my \"machine\"", 10.0 / 3.0, 3.7e8};
  const slicing::CostProfile read = parse_profile(write(to_toml(profile, {"one", "two"})));
  EXPECT_EQ(read.name, profile.name);
  EXPECT_EQ(read.vertices_per_s, profile.vertices_per_s);
  EXPECT_EQ(read.pixels_per_s, profile.pixels_per_s);
  const slicing::CostProfile again = parse_profile(to_text(read));
  EXPECT_EQ(again.name, profile.name);
  EXPECT_EQ(again.vertices_per_s, profile.vertices_per_s);
}

TEST_F(ProfileFile, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(error_of("name = \"x\"\nvertices_per_s = 1.0\n").find("pixels_per_s"),
            std::string::npos);
  EXPECT_NE(error_of("vertices_per_s = -1\npixels_per_s = 2\n").find("line 1"), std::string::npos);
  EXPECT_NE(error_of("vertices_per_s = inf\npixels_per_s = 2\n").find("speed"), std::string::npos);
  EXPECT_NE(error_of("speed = 3\n").find("unknown key"), std::string::npos);
  EXPECT_NE(error_of("name = [").find(path_), std::string::npos);
  for (const char* text : {"geforce4", "a,b,c", "a,1", "a,0,1", "a,1,nan", "a,1e-320,1", ",1,1",
                           "geforce2-mx,1,1", "missing.toml"})
    EXPECT_THROW(parse_profile(text), InputError) << text;
}

// Its own name, or the file's: never that of a profile with other speeds.
TEST_F(ProfileFile, HasANameOfItsOwn) {
  const std::string speeds = "vertices_per_s = 5e6\npixels_per_s = 1e8\n";
  EXPECT_EQ(parse_profile(write(speeds)).name, std::filesystem::path(path_).stem().string());
  EXPECT_NE(error_of("name = \"geforce2-mx\"\n" + speeds).find("no other"), std::string::npos);
  EXPECT_NE(error_of("name = \"\"\n" + speeds).find("name"), std::string::npos);
  EXPECT_EQ(parse_profile(to_text(known_profiles().front())).name, known_profiles().front().name);
}

TEST_F(ProfileFile, StandsInAChoiceForItsNumbers) {
  const Method& method = find_method(built_in_methods(), "hybrid-slicing");
  write("name = \"mine\"\nvertices_per_s = 5e6\npixels_per_s = 1e8\n");
  const MethodChoice choice = resolved_choice(method, {"", {{"profile", path_}}});
  EXPECT_EQ(choice.variant, "conservative");
  EXPECT_EQ(choice.parameters.at("profile"), "mine,5000000.0,100000000.0");
  EXPECT_EQ(resolved_choice(method, choice).parameters, choice.parameters);
  EXPECT_THROW(resolved_choice(method, {"", {{"profiles", path_}}}), InputError);
  EXPECT_THROW(resolved_choice(method, {"printed", {}}), InputError);
}

}  // namespace
}  // namespace plumb::audit
