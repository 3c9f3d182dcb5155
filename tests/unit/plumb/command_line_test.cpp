// What a command line means, with a command of the test's own.
#include <gtest/gtest.h>

#include <memory>

#include "command.h"
#include "core/check.h"

namespace plumb::tool {
namespace {

struct Heard {
  std::string place, word = "one", output;
  std::vector<std::string> limits;
  int count = 1;
  double size = 1.5;
  std::optional<double> angle;
  bool loud = false;
};

// A command that remembers what it was told, and ends as it is told.
std::vector<Command> commands(
    Heard& heard, const std::function<int()>& ending = [] { return 0; }) {
  Command command;
  command.name = "go";
  command.summary = "Go somewhere";
  command.example = "plumb go there";
  command.declare = [&heard, ending](Options& options) -> Action {
    options.argument(heard.place, "PLACE", "Where to");
    options.choice(heard.word, "--word", {"one", "two"}, "A word");
    options.text(heard.output, "-o,--output", "PATH", "A file");
    options.texts(heard.limits, "--limit", "M=V", "A limit");
    options.integer(heard.count, "--count", "N", "A number", 1, 9);
    options.number(heard.size, "--size", "V", "A number");
    options.number(heard.angle, "--angle", "V", "A number");
    options.flag(heard.loud, "--loud", "Loudly");
    return [ending](const Invocation&) { return ending(); };
  };
  return {command};
}

Request read(Heard& heard, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "plumb");
  return read_command_line(commands(heard), {arguments});
}

// Reads and runs: the options reach their variables when the command line is read.
Heard heard_of(std::vector<std::string> arguments) {
  Heard heard;
  EXPECT_TRUE(static_cast<bool>(read(heard, std::move(arguments)).action));
  return heard;
}

std::string error_of(std::vector<std::string> arguments) {
  Heard heard;
  try {
    read(heard, std::move(arguments));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CommandLine, HandsTheOptionsOver) {
  const Heard heard =
      heard_of({"go", "there", "--word", "two", "-o", "f", "--limit", "a=1", "--limit", "b=2",
                "--count", "9", "--size", "-2.5", "--angle", "1e3", "--loud"});
  EXPECT_EQ(heard.place, "there");
  EXPECT_EQ(heard.word, "two");
  EXPECT_EQ(heard.output, "f");
  EXPECT_EQ(heard.limits, (std::vector<std::string>{"a=1", "b=2"}));
  EXPECT_EQ(heard.count, 9);
  EXPECT_EQ(heard.size, -2.5);
  EXPECT_EQ(heard.angle, 1000.0);
  EXPECT_TRUE(heard.loud);
}

TEST(CommandLine, LeavesAloneWhatIsNotGiven) {
  const Heard heard = heard_of({"go", "there"});
  EXPECT_EQ(heard.word, "one");
  EXPECT_EQ(heard.size, 1.5);
  EXPECT_FALSE(heard.angle.has_value());
  EXPECT_FALSE(heard.loud);
}

TEST(CommandLine, TakesARepeatedOptionWithoutSwallowingArguments) {
  const Heard heard = heard_of({"go", "--limit", "a=1", "there"});
  EXPECT_EQ(heard.place, "there");
  EXPECT_EQ(heard.limits.size(), 1u);
}

TEST(CommandLine, SaysWhatIsWrongWithIt) {
  EXPECT_EQ(error_of({"go"}), "PLACE is required (see 'plumb go --help')");
  EXPECT_EQ(error_of({"go", "a", "b"}), "unexpected argument 'b' (see 'plumb go --help')");
  EXPECT_EQ(error_of({"go", "--fast"}), "unknown option '--fast' (see 'plumb go --help')");
  EXPECT_EQ(error_of({"come"}), "unknown command 'come', there are: go (see 'plumb --help')");
  EXPECT_EQ(error_of({"--fast"}), "unknown option '--fast' (see 'plumb --help')");
  EXPECT_EQ(error_of({"--json"}), "--json requires --version (see 'plumb --help')");
  EXPECT_EQ(error_of({"go", "a", "--word", "three"}),
            "--word: 'three': expected one, two (see 'plumb go --help')");
  EXPECT_EQ(error_of({"go", "a", "--count", "10"}),
            "--count '10': expected a whole number from 1 to 9");
  EXPECT_EQ(error_of({"go", "a", "--size", "wide"}), "--size 'wide': expected a number");
}

TEST(CommandLine, AnswersWithHelp) {
  Heard heard;
  const std::string help = read(heard, {"go", "--help"}).answer;
  EXPECT_NE(help.find("Go somewhere"), std::string::npos);
  EXPECT_NE(help.find("--word one|two"), std::string::npos);
  EXPECT_NE(help.find("Example:\n  plumb go there"), std::string::npos);
  EXPECT_NE(read(heard, {}).answer.find("Subcommands"), std::string::npos);
  EXPECT_NE(read(heard, {"--help"}).answer.find("Subcommands"), std::string::npos);
}

TEST(CommandLine, CanBeTypedAgain) {
  const Invocation invocation{
      {"/usr/bin/plumb", "info", "generate:alpine?size=9&seed=7", "it's", "", "-o", "out/a.json"}};
  EXPECT_EQ(invocation.command_line(),
            "plumb info 'generate:alpine?size=9&seed=7' 'it'\\''s' '' -o out/a.json");
}

int status_of(const std::function<int()>& ending) {
  Heard heard;
  return run_command_line(commands(heard, ending), {{"plumb", "go", "there"}});
}

TEST(ExitStatus, IsTheCommandsOwnOrTwoForEveryException) {
  EXPECT_EQ(status_of([] { return 0; }), 0);
  EXPECT_EQ(status_of([] { return 1; }), 1);
  EXPECT_EQ(status_of([]() -> int { throw InputError("x"); }), 2);
  EXPECT_EQ(status_of([]() -> int { throw std::invalid_argument("x"); }), 2);
  EXPECT_EQ(status_of([]() -> int { throw std::bad_alloc(); }), 2);
  EXPECT_EQ(status_of([]() -> int { throw std::runtime_error("x"); }), 2);
}

TEST(ErrorLine, IsOneLineWhateverTheMessage) {
  ::testing::internal::CaptureStderr();
  status_of([]() -> int { throw InputError("two\n  lines\r\n"); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "plumb: two lines\n");
  ::testing::internal::CaptureStderr();
  status_of([]() -> int { throw std::bad_alloc(); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "plumb: out of memory: the input is too large for this machine\n");
}

}  // namespace
}  // namespace plumb::tool
