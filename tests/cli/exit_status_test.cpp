// Every way in which the command ends, and what it says then.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

// One line that begins with "plumb: ", and nothing on standard output.
void expect_one_error_line(const CommandResult& result, const std::string& part) {
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err.rfind("plumb: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
}

TEST(ExitStatus, IsZeroWhenAllIsWell) {
  const CommandResult result = run_plumb({"info", "generate:plane?size=9"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("9 x 9 samples"), std::string::npos);
}

TEST(ExitStatus, IsTwoForWhatIsWrongWithTheCommandLine) {
  expect_one_error_line(run_plumb({"inform"}), "unknown command 'inform'");
  expect_one_error_line(run_plumb({"info"}), "TERRAIN is required");
  expect_one_error_line(run_plumb({"info", "generate:plane", "--fast"}), "unknown option '--fast'");
  expect_one_error_line(run_plumb({"info", "generate:plane", "--threads", "no"}), "--threads 'no'");
  expect_one_error_line(run_plumb({"info", "generate:plane", "--preview", "a.jpg"}), ".png");
}

TEST(ExitStatus, IsTwoForAnInstructionSetThatIsNone) {
  expect_one_error_line(run_plumb({"--version"}, {.environment = {{"PLUMB_ISA", "mmx"}}}),
                        "PLUMB_ISA must be sse2, avx2 or avx512, got 'mmx'");
}

TEST(ExitStatus, IsTwoForWhatIsWrongWithTheInput) {
  expect_one_error_line(run_plumb({"info", "no-such-file.tif"}), "no-such-file.tif");
  expect_one_error_line(run_plumb({"info", "generate:planet"}), "planet");
  expect_one_error_line(run_plumb({"info", "generate:plane?sise=9"}), "sise");
  expect_one_error_line(run_plumb({"info", PLUMB_SOURCE_DIR "/LICENSE"}), "LICENSE");
  expect_one_error_line(run_plumb({"info", PLUMB_SOURCE_DIR}), PLUMB_SOURCE_DIR);
}

TEST(ExitStatus, IsTwoIfTheResultCannotBeWritten) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const CommandResult full = run_command(
      {"sh", "-c", "exec \"$0\" info 'generate:plane?size=9' > /dev/full", PLUMB_BIN_DIR "/plumb"});
  expect_one_error_line(full, "cannot write to standard output: No space left on device");
  expect_one_error_line(
      run_plumb({"info", "generate:plane?size=9", "--preview", "/no/such/folder/a.png"}),
      "/no/such/folder/a.png");
}

// 2 GB of address space stand for a small machine; 30000 x 30000 heights take 3.6 GB.
TEST(ExitStatus, IsTwoForATerrainThatDoesNotFitIntoMemory) {
  const auto run_small = [](const std::string& arguments) {
    return run_command(
        {"sh", "-c", "ulimit -v 2000000; exec \"$0\" " + arguments, PLUMB_BIN_DIR "/plumb"});
  };
  if (run_small("--version").status != 0)
    GTEST_SKIP() << "this build cannot start with so little (a sanitizer's cannot)";
  expect_one_error_line(run_small("info 'generate:plane?size=30000'"), "bytes");
}

// 65536 x 65536 pixels take more than a hundred gigabytes.
TEST(ExitStatus, IsTwoForAPictureThatDoesNotFitIntoMemory) {
  const std::string terrain = "generate:alpine?size=33", size = "65536x65536";
  expect_one_error_line(run_plumb({"truth", terrain, "--size", size}), "bytes");
  expect_one_error_line(run_plumb({"audit", terrain, "--tolerance", "1px", "--size", size}),
                        "bytes");
  expect_one_error_line(run_plumb({"render", terrain, "--size", size, "-o", "-"}), "bytes");
}

TEST(ExitStatus, IsTwoForALimitWithoutItsUnitWhichIsNamed) {
  expect_one_error_line(run_plumb({"audit", "generate:alpine?size=33", "--tolerance", "1px",
                                   "--limit", "pixel-error=1"}),
                        "limit 'pixel-error=1'");
}

TEST(ExitStatus, IsTwoForAFolderOnStandardOutput) {
  expect_one_error_line(
      run_plumb({"audit", "generate:alpine?size=33", "--tolerance", "1px", "-o", "-"}), "folder");
}

}  // namespace
}  // namespace plumb::testing
