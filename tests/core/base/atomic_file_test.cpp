#include "core/base/atomic_file.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

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

std::string ErrorOfWriting(const std::filesystem::path& path) {
  const Status status = WriteFileAtomically(path, "x");
  if (status) return "was written";
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
  EXPECT_NE(status.error().message.find(path.string()), std::string::npos);
  return status.error().message;
}

TEST(AtomicFile, WritesThroughALinkWhichStaysOne) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "elsewhere");
  ASSERT_TRUE(WriteFileAtomically(folder / "elsewhere" / "file", "old"));
  std::filesystem::create_symlink("elsewhere/file", folder / "link");
  std::filesystem::create_symlink("link", folder / "link_to_link");
  ASSERT_TRUE(WriteFileAtomically(folder / "link_to_link", "new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link_to_link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(ReadFile(folder / "elsewhere" / "file").value(), "new");
}

TEST(AtomicFile, WritesTheFileThatALinkPromises) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink(folder / "later", folder / "link");
  ASSERT_TRUE(WriteFileAtomically(folder / "link", "x"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(ReadFile(folder / "later").value(), "x");
}

TEST(AtomicFile, RefusesWhatIsNoRegularFileAndLeavesItAsItIs) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(ErrorOfWriting(pipe).find("is a pipe"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  std::filesystem::create_symlink("/dev/null", folder / "null");
  EXPECT_NE(ErrorOfWriting(folder / "null").find("is a device"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(folder.EntryCount(), 2);
}

TEST(AtomicFile, RefusesLinksInACircleAndOpenStreams) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("b", folder / "a");
  std::filesystem::create_symlink("a", folder / "b");
  EXPECT_NE(ErrorOfWriting(folder / "a").find("in a circle"), std::string::npos);
  EXPECT_NE(ErrorOfWriting("/dev/stdout").find("open stream"), std::string::npos);
}

TEST(AtomicFile, AFileThatIsReplacedKeepsItsPermissions) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "file", "old"));
  std::filesystem::permissions(
      folder / "file", std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  ASSERT_TRUE(WriteFileAtomically(folder / "file", "new"));
  EXPECT_EQ(std::filesystem::status(folder / "file").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(AppendToFile, GrowsAFileAndRefusesWhatIsNone) {
  const TemporaryFolder folder;
  ASSERT_TRUE(AppendToFile(folder / "table", "one\n"));
  ASSERT_TRUE(AppendToFile(folder / "table", "two\n"));
  EXPECT_EQ(ReadFile(folder / "table").value(), "one\ntwo\n");
  EXPECT_EQ(AppendToFile("/dev/full", "x").error().code, ErrorCode::kIo);
}

TEST(ReadFile, APipeWithoutAWriterIsRefusedNotWaitedFor) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto bytes = ReadFile(pipe);
  ASSERT_FALSE(bytes);
  EXPECT_NE(bytes.error().message.find("pipe: is a pipe, not a file"), std::string::npos);
}

TEST(ReadFile, ADeviceThatNeverEndsIsRefused) {
  EXPECT_EQ(ReadFile("/dev/zero").error().code, ErrorCode::kIo);
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
