#include "core/base/log_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/base/atomic_file.h"
#include "core/base/log.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

TEST(LogFile, LiesInTheUsersStateFolder) {
  ::setenv("XDG_STATE_HOME", "/state", 1);
  EXPECT_EQ(LogFileOf("workstation"), "/state/foresight/workstation.log");
  ::unsetenv("XDG_STATE_HOME");
  ::setenv("HOME", "/home/op", 1);
  EXPECT_EQ(LogFileOf("workstation"), "/home/op/.local/state/foresight/workstation.log");
  ::unsetenv("HOME");
  EXPECT_TRUE(LogFileOf("workstation").empty());
}

TEST(LogFile, KeepsEveryLineWithItsDateAndLevel) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "a/b/x.log";
  ASSERT_TRUE(KeepLogFile(file));
  LogWarning("the lamp is {}", "broken");
  const std::string text = ReadFile(file).value();
  EXPECT_THAT(text, testing::StartsWith("20"));
  EXPECT_THAT(text, HasSubstr(" warning the lamp is broken\n"));
}

TEST(LogFile, AFolderThatCannotBeMadeIsAnIoError) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  const Status kept = KeepLogFile(folder / "file/x.log");
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace foresight
