#include "hardware/link/chunks/spool_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

constexpr const char* kScan = "0f0e8b5a-1111-4222-8333-444455556666";

Chunk SomeChunk(Random& random, std::int64_t item, int bytes) {
  std::string content;
  for (int i = 0; i < bytes; ++i) content.push_back(static_cast<char>(random.Index(256)));
  return SplitItem({ChunkKind::kRanges, item}, content).value().front();
}

std::vector<Chunk> SomeChunks(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Chunk> chunks;
  for (int i = 0; i < count; ++i) chunks.push_back(SomeChunk(random, i, random.Index(3000)));
  return chunks;
}

struct Opened {
  Result<std::unique_ptr<SpoolFile>> spool;
  std::vector<Chunk> chunks;
};

Opened Open(const std::filesystem::path& folder) {
  std::vector<Chunk> chunks;
  auto spool = SpoolFile::Open(folder, kScan, [&](const Chunk& chunk) { chunks.push_back(chunk); });
  return {std::move(spool), std::move(chunks)};
}

std::vector<Chunk> ChunksIn(const std::filesystem::path& folder) {
  const Opened opened = Open(folder);
  EXPECT_TRUE(opened.spool) << opened.spool.error().message;
  return opened.chunks;
}

TEST(SpoolFile, KeepsWhatWasAppended) {
  const TemporaryFolder folder;
  auto chunks = SomeChunks(1, 40);
  Random random(2);
  chunks.push_back(SomeChunk(random, 99, static_cast<int>(kMaxPartBytes)));
  {
    const auto opened = Open(folder / "spools");
    ASSERT_TRUE(opened.spool) << opened.spool.error().message;
    EXPECT_TRUE(opened.chunks.empty());
    ASSERT_TRUE((*opened.spool)->Append(std::span(chunks).first(25)));
    ASSERT_TRUE((*opened.spool)->Append(std::span(chunks).subspan(25)));
    ASSERT_TRUE((*opened.spool)->Append({}));
  }
  EXPECT_TRUE(ChunksIn(folder / "spools") == chunks);
}

TEST(SpoolFile, LongSpoolsAreReadWhole) {
  const TemporaryFolder folder;
  Random random(3);
  std::vector<Chunk> chunks;
  for (int i = 0; i < 60; ++i)
    chunks.push_back(SomeChunk(random, i, 50'000 + random.Index(10'000)));
  ASSERT_TRUE((*Open(folder.path()).spool)->Append(chunks));
  EXPECT_TRUE(ChunksIn(folder.path()) == chunks);
}

TEST(SpoolFile, ATornTailIsCutWhereverItEnds) {
  const TemporaryFolder folder;
  const auto chunks = SomeChunks(4, 4);
  std::filesystem::path path;
  {
    const auto opened = Open(folder.path());
    ASSERT_TRUE((*opened.spool)->Append(chunks));
    path = (*opened.spool)->path();
  }
  const std::string whole = ReadFile(path).value();
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 40) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << whole.substr(0, size);
    {
      const auto opened = Open(folder.path());
      ASSERT_TRUE(opened.spool) << opened.spool.error().message;
      ASSERT_LT(opened.chunks.size(), chunks.size());
      for (std::size_t i = 0; i < opened.chunks.size(); ++i)
        ASSERT_TRUE(opened.chunks[i] == chunks[i]);
      ASSERT_TRUE((*opened.spool)->Append(std::span(chunks).subspan(opened.chunks.size())));
    }
    ASSERT_TRUE(ChunksIn(folder.path()) == chunks) << "appended behind a tail of " << size;
  }
}

TEST(SpoolFile, FlippedBitsCostWhatFollowsAndNothingBefore) {
  const TemporaryFolder folder;
  const auto chunks = SomeChunks(5, 20);
  std::filesystem::path path;
  {
    const auto opened = Open(folder.path());
    ASSERT_TRUE((*opened.spool)->Append(chunks));
    path = (*opened.spool)->path();
  }
  const std::string whole = ReadFile(path).value();
  Random random(6);
  for (int trial = 0; trial < 100; ++trial) {
    std::string bad = whole;
    const auto at = 60 + static_cast<std::size_t>(random.Index(static_cast<int>(bad.size()) - 60));
    bad[at] = static_cast<char>(bad[at] ^ 1 << random.Index(8));
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bad;
    const auto opened = Open(folder.path());
    ASSERT_TRUE(opened.spool);
    ASSERT_LT(opened.chunks.size(), chunks.size());
    for (std::size_t i = 0; i < opened.chunks.size(); ++i)
      ASSERT_TRUE(opened.chunks[i] == chunks[i]);
  }
}

TEST(SpoolFile, AFullDiskIsSaidAndLeavesTheFileUsable) {
  const TemporaryFolder folder;
  const auto chunks = SomeChunks(7, 20);
  {
    const auto opened = Open(folder.path());
    SpoolFile& spool = **opened.spool;
    ASSERT_TRUE(spool.Append(std::span(chunks).first(10)));
    {
      const FileSizeLimit limit(static_cast<rlim_t>(spool.size_bytes()) + 3000);
      const auto status = spool.Append(std::span(chunks).subspan(10));
      ASSERT_FALSE(status);
      EXPECT_EQ(status.error().code, ErrorCode::kIo);
      EXPECT_NE(status.error().message.find(spool.path().string()), std::string::npos);
    }
    ASSERT_TRUE(spool.Append(std::span(chunks).subspan(10)));
  }
  EXPECT_TRUE(ChunksIn(folder.path()) == chunks);
}

TEST(SpoolFile, OneProgramAtATimeHasItOpen) {
  const TemporaryFolder folder;
  const auto first = Open(folder.path());
  ASSERT_TRUE(first.spool);
  EXPECT_EQ(Open(folder.path()).spool.error().code, ErrorCode::kIo);
}

TEST(SpoolFile, RefusesNamesThatLeadOutOfTheFolder) {
  const TemporaryFolder folder;
  for (const char* id : {"", "../x", "a/b", "..", "a b", "caf\xc3\xa9"})
    EXPECT_EQ(SpoolFile::Open(folder.path(), id, [](const Chunk&) {}).error().code,
              ErrorCode::kInvalidInput)
        << id;
}

TEST(SpoolFile, RefusesAFileThatIsNoneOfIts) {
  const TemporaryFolder folder;
  const std::string name = std::string(kScan) + ".spool";
  const auto path = folder / name;
  std::ofstream(path) << "a letter to somebody, long enough to be no torn head of a spool at all, "
                         "and no spool either";
  EXPECT_EQ(Open(folder.path()).spool.error().code, ErrorCode::kBadData);
  EXPECT_GT(ReadFile(path)->size(), 60U) << "it was left alone";
}

TEST(SpoolFile, RefusesChunksThatAReaderWouldRefuse) {
  const TemporaryFolder folder;
  const auto opened = Open(folder.path());
  auto chunks = SomeChunks(8, 1);
  chunks[0].crc ^= 1;
  EXPECT_EQ((*opened.spool)->Append(chunks).error().code, ErrorCode::kBadData);
}

TEST(SpoolFile, AFolderListsItsScans) {
  const TemporaryFolder folder;
  EXPECT_TRUE(ListSpools(folder / "none")->empty());
  const auto no_reader = [](const Chunk&) {};
  auto b = SpoolFile::Open(folder.path(), "b-2", no_reader).value();
  auto a = SpoolFile::Open(folder.path(), "a-1", no_reader).value();
  std::ofstream(folder / "c.spool") << "nothing of ours";
  std::ofstream(folder / "note.txt") << "hello";
  ASSERT_TRUE(a->Append(SomeChunks(9, 3)));
  const auto spools = ListSpools(folder.path()).value();
  ASSERT_EQ(spools.size(), 2U);
  EXPECT_EQ(spools[0].scan_id, "a-1");
  EXPECT_EQ(spools[0].bytes, a->size_bytes());
  EXPECT_EQ(spools[1].scan_id, "b-2");
  ASSERT_TRUE(b->Remove());
  EXPECT_EQ(ListSpools(folder.path())->size(), 1U);
}

/// Appends chunks one by one and tells the pipe after each; never returns.
[[noreturn]] void AppendUntilKilled(const std::filesystem::path& folder, int pipe_end) {
  const auto chunks = SomeChunks(10, 5000);
  const auto opened = Open(folder);
  for (std::size_t i = opened.chunks.size(); i < chunks.size(); ++i) {
    if (!(*opened.spool)->Append(std::span(chunks).subspan(i, 1))) _exit(1);
    if (write(pipe_end, "x", 1) != 1) _exit(1);
  }
  _exit(0);
}

TEST(SpoolFile, WhatWasAppendedSurvivesSIGKILL) {
  const TemporaryFolder folder;
  const auto chunks = SomeChunks(10, 5000);
  Random random(11);
  std::size_t kept = 0;
  for (int kill_number = 0; kill_number < 10; ++kill_number) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    const pid_t child = fork();
    if (child == 0) AppendUntilKilled(folder.path(), ends[1]);
    close(ends[1]);
    char told = 0;
    const int until = 1 + random.Index(20);
    for (int i = 0; i < until && read(ends[0], &told, 1) == 1; ++i) ++kept;
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while (read(ends[0], &told, 1) == 1) ++kept;
    close(ends[0]);
    const auto read_back = ChunksIn(folder.path());
    ASSERT_GE(read_back.size(), kept);
    kept = read_back.size();
    for (std::size_t i = 0; i < kept; ++i) ASSERT_TRUE(read_back[i] == chunks[i]) << i;
  }
  EXPECT_GE(kept, 10U);
}

}  // namespace
}  // namespace foresight
