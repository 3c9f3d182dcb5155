// plumb soundness, and that the command it prints for a case does what it did.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "audit/soundness/soundness.h"
#include "support/run_command.h"

namespace plumb::testing {
namespace {

namespace soundness = audit::soundness;

int status_of(soundness::Ending ending) {
  return ending == soundness::Ending::Held ? 0 : ending == soundness::Ending::Broken ? 1 : 2;
}

// As a person at a shell, with the built command on the path.
CommandResult run_line(const std::string& line) {
  return run_command({"sh", "-c", "PATH=" PLUMB_BIN_DIR ":$PATH; " + line});
}

TEST(SoundnessCommandLine, OfACaseGivesItsOutcomeAgain) {
  const audit::MethodTable& table = audit::built_in_methods();
  int engines = 0, refused = 0;
  for (std::int64_t k = 0; k < 40; ++k) {
    const soundness::Case drawn = soundness::draw_case(table, 1, k);
    const soundness::Outcome outcome = soundness::outcome_of(table, drawn.scene);
    const std::string line = soundness::audit_command(drawn.scene);
    const CommandResult result = run_line(line + " --json");
    EXPECT_EQ(result.status, status_of(outcome.ending)) << line << "\n" << result.err;
    engines += drawn.scene.camera.engine.has_value();
    refused += outcome.ending == soundness::Ending::Refused;
    if (outcome.ending == soundness::Ending::Refused) continue;
    const auto json = nlohmann::json::parse(result.out);
    int claims = 0;
    for (const auto& claim : json.at("claims")) {
      const bool of_frame = claim.at("scope") == "frame";
      claims += of_frame && claim.at("verdict") != "not measured";
    }
    EXPECT_EQ(claims, outcome.claims) << line;
  }
  EXPECT_GE(engines, 1);
  EXPECT_GE(refused, 1);
}

TEST(SoundnessCommandLine, HasTheSameBytesOnAnyNumberOfThreads) {
  const auto run = [](const char* threads) {
    return run_plumb({"soundness", "--draws", "30", "--threads", threads});
  };
  const CommandResult one = run("1");
  EXPECT_EQ(one.status, 0) << one.out << one.err;
  EXPECT_EQ(run("4").out, one.out);
  EXPECT_NE(one.out.find("Every conservative claim holds in 30 draws."), std::string::npos);
}

TEST(SoundnessCommandLine, DrawsOneMethodFromOnePlaceOn) {
  const CommandResult result =
      run_plumb({"soundness", "--draws", "5", "--first", "20", "--method", "slicing", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("first"), 20);
  EXPECT_EQ(json.at("distribution").at("method").at("slicing"), 5);
  EXPECT_EQ(json.at("distribution").at("method").at("full"), 0);
  EXPECT_TRUE(json.at("failures").empty());
}

TEST(SoundnessCommandLine, ListsTheCommandsAndRunsNone) {
  const CommandResult result = run_plumb({"soundness", "--draws", "4", "--commands"});
  EXPECT_EQ(result.status, 0);
  std::istringstream lines(result.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_EQ(line, soundness::audit_command(
                        soundness::draw_case(audit::built_in_methods(), 1, count).scene));
  EXPECT_EQ(count, 4);
}

TEST(SoundnessCommandLine, RefusesWhatItCannotDraw) {
  EXPECT_EQ(run_plumb({"soundness", "--draws", "0"}).status, 2);
  EXPECT_EQ(run_plumb({"soundness", "--method", "none"}).status, 2);
}

}  // namespace
}  // namespace plumb::testing
