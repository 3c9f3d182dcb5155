// An interrupted command leaves nothing behind.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "core/atomic_file.h"
#include "support/run_command.h"

namespace plumb::testing {
namespace {

TEST(Interruption, EndsWith130AndNoFile) {
  const TemporaryFolder folder;
  CommandOptions options;
  options.signal = SIGINT;
  options.signal_after = std::chrono::milliseconds(300);
  const CommandResult result =
      run_plumb({"info", "generate:alpine?size=8193", "--preview", folder.file("p.png")}, options);
  EXPECT_EQ(result.status, 130);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(folder.names().empty());
}

// A process of its own: it writes half a file and is then interrupted.
TEST(Interruption, RemovesTheTemporaryFileThatIsBeingWritten) {
  const TemporaryFolder folder;
  EXPECT_EXIT(
      {
        remove_temporary_files_on_interrupt();
        const TemporarySibling sibling(folder.file("a.bin"));
        std::ofstream(sibling.path()) << "half of it";
        if (folder.names().size() != 1) std::_Exit(1);
        std::raise(SIGTERM);
      },
      ::testing::ExitedWithCode(143), "");
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace plumb::testing
