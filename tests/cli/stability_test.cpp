// plumb stability, run as a person would.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

TEST(StabilityCommand, PrintsWhatWasMeasuredAndEndsWithZeroIfAllIsAsStated) {
  const CommandResult result = run_plumb({"stability", "spike-straight-down"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("1 of 1 scenes are as expected."), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("broken"), std::string::npos);
}

TEST(StabilityCommand, ListsScenesWithoutDrawingThem) {
  const CommandResult result = run_plumb({"stability", "--list", "--method", "chunked"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find("error-over-distance-of-chunks"), std::string::npos);
  EXPECT_EQ(result.out.find("vertical-walls"), std::string::npos);
}

TEST(StabilityCommand, WritesPicturesAndPages) {
  const TemporaryFolder folder;
  const CommandResult result =
      run_plumb({"stability", "spike-straight-down", "-o", folder.path() / "made"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* name :
       {"failures.md", "failures.html", "figures/failures/spike-straight-down.png"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "made" / name)) << name;
}

TEST(StabilityCommand, HasTheSameJsonOnAnyNumberOfThreads) {
  const std::vector<std::string> command{"stability", "wide-field-of-view", "inner-minimum",
                                         "--json", "--threads"};
  const auto on = [&](const char* threads) {
    std::vector<std::string> whole = command;
    whole.push_back(threads);
    return run_plumb(whole).out;
  };
  const std::string alone = on("1");
  EXPECT_EQ(alone, on("2"));
  const nlohmann::json json = nlohmann::json::parse(alone);
  EXPECT_EQ(json.at("scenes").size(), 2u);
  EXPECT_EQ(json.at("command"), "plumb stability wide-field-of-view inner-minimum --json");
  EXPECT_TRUE(json.at("as_expected"));
}

TEST(StabilityCommand, RefusesWhatItCannotDo) {
  const CommandResult unknown = run_plumb({"stability", "spikes"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("spike-straight-down"), std::string::npos);
  EXPECT_EQ(run_plumb({"stability", "spike-straight-down", "--method", "slicing"}).status, 2);
  EXPECT_EQ(run_plumb({"stability", "-o", "-"}).status, 2);
}

}  // namespace
}  // namespace plumb::testing
