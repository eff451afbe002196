#include "core/base/atomic_file.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

TEST(AtomicFile, WritesAndReadsBackEveryByte) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\n\xff", 5);
  ASSERT_TRUE(WriteFileAtomically(folder / "file", bytes));
  EXPECT_EQ(ReadFile(folder / "file").value(), bytes);
}

TEST(AtomicFile, LeavesNothingBesideTheFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "file", "x"));
  EXPECT_EQ(folder.EntryCount(), 1);
}

TEST(AtomicFile, AFailedWriteSaysWhereAndLeavesTheOldFile) {
  const TemporaryFolder folder;
  const auto status = WriteFileAtomically(folder / "missing" / "file", "x");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
  EXPECT_NE(status.error().message.find("missing/file"), std::string::npos);
}

TEST(AtomicFile, RefusesToReplaceAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "name");
  EXPECT_FALSE(WriteFileAtomically(folder / "name", "x"));
  EXPECT_EQ(folder.EntryCount(), 1);
}

TEST(ReadFile, RefusesAFileBeyondTheLimit) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "file", "0123456789"));
  EXPECT_EQ(ReadFile(folder / "file", 9).error().code, ErrorCode::kBadData);
}

TEST(ReadFile, SaysThatAFolderIsAFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(ReadFile(folder.path()).error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace foresight
