#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/diff_missions.h"
#include "core/mission/merge_missions.h"
#include "core/mission/mission_index.h"
#include "core/mission/mission_schema.h"
#include "core/mission/salvage_mission.h"
#include "core/mission/side_result.h"
#include "tests/core/mission/sample_scan.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class NotesTest : public testing::Test {
 protected:
  static NoteRecord Note(const std::string& uuid, const std::string& text,
                         std::int64_t scan_id = 0) {
    NoteRecord note;
    note.uuid = uuid;
    note.kind = kNoteKind;
    note.scan_id = scan_id;
    note.text = text;
    note.utc_ns = 1000;
    note.author = "ada";
    return note;
  }

  /// A mission with a scan a seed, a note on each, and one on the mission.
  std::filesystem::path Mission(const std::string& name, const std::vector<std::uint64_t>& seeds) {
    const std::filesystem::path path = folder_ / name;
    const auto mission = MissionFile::Create(path).value();
    for (const std::uint64_t seed : seeds) {
      const std::int64_t id = Record(*mission, SampleScan(seed));
      NoteRecord note = Note("note of " + std::to_string(seed), "the rim is bent", id);
      note.tags = "#Crack, rim";
      EXPECT_TRUE(mission->AddNote(note));
    }
    EXPECT_TRUE(mission->AddNote(Note("note of " + name, "windy")));
    EXPECT_TRUE(mission->Close());
    return path;
  }

  static std::vector<NoteRecord> NotesIn(const std::filesystem::path& path) {
    return MissionFile::OpenReadOnly(path).value()->ListNotes().value();
  }
  static std::vector<std::string> Uuids(const std::filesystem::path& path) {
    std::vector<std::string> uuids;
    for (const NoteRecord& note : NotesIn(path)) uuids.push_back(note.uuid);
    return uuids;
  }

  TemporaryFolder folder_;
};

TEST_F(NotesTest, ANoteKnowsItsScanItsTagsItsAuthorAndItsTime) {
  const auto path = Mission("a.foresight", {1});
  const std::vector<NoteRecord> notes = NotesIn(path);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].scan_uuid, "scan-1");
  EXPECT_EQ(notes[0].text, "the rim is bent");
  EXPECT_EQ(notes[0].tags, "crack rim");
  EXPECT_EQ(notes[0].made_by, "ada");
  EXPECT_EQ(notes[0].made_utc_ns, 1000);
  EXPECT_EQ(notes[1].scan_id, 0) << "it is about the mission";
}

TEST_F(NotesTest, TheLastStateCountsAndTheFirstTellsWhoMadeIt) {
  const auto path = Mission("a.foresight", {1});
  const auto mission = MissionFile::Open(path).value();
  NoteRecord changed = mission->ListNotes().value()[0];
  changed.text = "the rim is cracked";
  changed.author = "bob";
  changed.utc_ns = 2000;
  ASSERT_TRUE(mission->AddNote(changed));
  NoteRecord now = mission->ListNotes().value()[0];
  EXPECT_EQ(now.text, "the rim is cracked");
  EXPECT_EQ(now.author, "bob");
  EXPECT_EQ(now.made_by, "ada");
  EXPECT_EQ(now.made_utc_ns, 1000);
  now.deleted = true;
  ASSERT_TRUE(mission->AddNote(now));
  EXPECT_TRUE(mission->ListNotes().value()[0].deleted);
  now.deleted = false;
  ASSERT_TRUE(mission->AddNote(now));
  EXPECT_FALSE(mission->ListNotes().value()[0].deleted);
  EXPECT_EQ(mission->ListNotes()->size(), 2u);
}

TEST_F(NotesTest, AScanThatIsNotThereIsRefusedButInAReview) {
  const auto path = Mission("a.foresight", {1});
  const auto mission = MissionFile::Open(path).value();
  NoteRecord note = Note("lost", "where?");
  note.scan_uuid = "scan-99";
  EXPECT_EQ(mission->AddNote(note).error().code, ErrorCode::kInvalidInput);
  note.kind = "poem";
  EXPECT_THAT(mission->AddNote(note).error().message, HasSubstr("'poem' is no kind of note"));
  const auto review = MissionFile::OpenReviewOf(path).value();
  note.kind = kNoteKind;
  EXPECT_TRUE(review->AddNote(note));
}

TEST_F(NotesTest, WhatAReviewSaysOfANoteCountsMoreThanTheMission) {
  const auto path = Mission("a.foresight", {1});
  const auto mission = MissionFile::Open(path).value();
  const auto review = MissionFile::OpenReviewOf(path).value();
  NoteRecord changed = mission->ListNotes().value()[0];
  changed.text = "the rim is cracked";
  changed.author = "bob";
  changed.scan_id = 0;  // rows of a review know scans by their uuid
  ASSERT_TRUE(review->AddNote(changed));
  ASSERT_TRUE(review->AddNote(Note("note of the review", "late")));
  EXPECT_EQ(NotesOfMission(*mission, nullptr).value(), mission->ListNotes().value());
  const std::vector<NoteRecord> notes = NotesOfMission(*mission, review.get()).value();
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_EQ(notes[0].text, "the rim is cracked");
  EXPECT_EQ(notes[0].made_by, "ada");
  EXPECT_EQ(notes[2].text, "late");
}

TEST_F(NotesTest, TagsAreShortWordsOnce) {
  EXPECT_EQ(TagsFrom("#Crack,  left-wheel;crack\nÄpfel").value(), "crack left-wheel Äpfel");
  EXPECT_EQ(TagsFrom("").value(), "");
  EXPECT_EQ(TagsFrom(std::string(41, 'x')).error().code, ErrorCode::kInvalidInput);
}

TEST_F(NotesTest, AFlippedBitIsNamed) {
  const auto path = Mission("a.foresight", {1});
  ASSERT_TRUE(SqliteDatabase::Open(path, SqliteDatabase::Mode::kReadWrite)
                  .value()
                  .Run("UPDATE note SET text = 'the rim is fine' WHERE id = 1"));
  const auto mission = MissionFile::OpenReadOnly(path).value();
  EXPECT_THAT(mission->ListNotes().error().message, HasSubstr("note 1 is damaged (checksum)"));
  EXPECT_EQ(mission->Verify({}).error().code, ErrorCode::kBadData);
}

TEST_F(NotesTest, AMissionOfFormat2TakesNotesAndKeepsItsScans) {
  const auto path = Mission("a.foresight", {1});
  {
    auto database = SqliteDatabase::Open(path, SqliteDatabase::Mode::kReadWrite).value();
    ASSERT_TRUE(database.Run("DROP TABLE note"));
    ASSERT_TRUE(database.Run("DROP TABLE given_line"));
    ASSERT_TRUE(database.Run("PRAGMA user_version = 2"));
  }
  EXPECT_THAT(NotesIn(path), IsEmpty());
  const Scan before = MissionFile::OpenReadOnly(path).value()->LoadScan(1).value();
  const auto mission = MissionFile::Open(path).value();
  EXPECT_TRUE(mission->AddNote(Note("new", "now it can")));
  EXPECT_EQ(mission->ListNotes()->size(), 1u);
  EXPECT_TRUE(SameButForTheRig(mission->LoadScan(1).value(), before));
}

TEST_F(NotesTest, AMergeTakesThemAllOnceWithTheirChanges) {
  const auto a = Mission("a.foresight", {1, 2}), b = Mission("b.foresight", {2, 3});
  {
    const auto review = MissionFile::OpenReviewOf(a).value();
    NoteRecord changed = NotesIn(a)[0];
    changed.scan_id = 0;  // it is in another file
    changed.text = "seen again: it is only paint";
    changed.utc_ns = 5000;
    ASSERT_TRUE(review->AddNote(changed));
  }
  const std::vector<std::filesystem::path> sources = {folder_ / "a.review.foresight", a, b};
  const auto merged = folder_ / "merged.foresight";
  EXPECT_EQ(MergeMissions(sources, merged, {}, {})->notes, 5);
  EXPECT_THAT(Uuids(merged), ElementsAre("note of 1", "note of 2", "note of a.foresight",
                                         "note of 3", "note of b.foresight"));
  EXPECT_EQ(NotesIn(merged)[0].text, "seen again: it is only paint") << "a review comes later";
  EXPECT_EQ(NotesIn(merged)[3].scan_id, 3);
  EXPECT_TRUE(MissionFile::OpenReadOnly(merged).value()->Verify({}));
}

TEST_F(NotesTest, AScanThatIsLeftOutTakesItsNotesWithIt) {
  const auto a = Mission("a.foresight", {1, 2});
  const auto pruned = folder_ / "pruned.foresight";
  MergeOptions options;
  options.keep = [](const ScanSummary& scan) { return scan.uuid == "scan-2"; };
  const std::vector<std::filesystem::path> sources = {a};
  ASSERT_TRUE(MergeMissions(sources, pruned, options, {}));
  EXPECT_THAT(Uuids(pruned), ElementsAre("note of 2", "note of a.foresight"));
}

TEST_F(NotesTest, ARecoveredMissionHasThem) {
  const auto a = Mission("a.foresight", {1, 2});
  const auto saved = folder_ / "saved.foresight";
  const SalvageReport report = SalvageMission(a, saved, {}, {}).value();
  EXPECT_EQ(report.notes, 3);
  EXPECT_THAT(report.losses, IsEmpty());
  EXPECT_EQ(NotesIn(saved), NotesIn(a));
}

TEST_F(NotesTest, ADiffNamesTheNoteThatChanged) {
  const auto a = Mission("a.foresight", {1});
  const auto b = folder_ / "b.foresight";
  ASSERT_TRUE(MissionFile::OpenReadOnly(a).value()->ExportTo(b));
  {
    const auto mission = MissionFile::Open(b).value();
    NoteRecord changed = mission->ListNotes().value()[0];
    changed.tags = "rim";
    ASSERT_TRUE(mission->AddNote(changed));
  }
  const auto differences =
      DiffMissions(*MissionFile::OpenReadOnly(a).value(), *MissionFile::OpenReadOnly(b).value(), {})
          .value();
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_EQ(differences[0].what, "note");
  EXPECT_EQ(differences[0].uuid, "note of 1");
  EXPECT_EQ(differences[0].text, "tags: was crack rim, is rim");
}

TEST_F(NotesTest, ASearchFindsTextsAndTagsButNothingDeleted) {
  const auto a = Mission("a.foresight", {1});
  const auto search = [&](const std::vector<std::string>& words) {
    MissionQuery query;
    query.words = words;
    query.what = "note";
    return SearchMissions(folder_.path(), query, {}, {}).value().hits;
  };
  ASSERT_EQ(search({"#crack"}).size(), 1u);
  EXPECT_EQ(search({"#crack"})[0].text, "note: the rim is bent, #crack #rim, by ada");
  EXPECT_EQ(search({"#crack"})[0].scan, 1);
  EXPECT_EQ(search({"windy"}).size(), 1u);
  {
    const auto mission = MissionFile::Open(a).value();
    NoteRecord gone = mission->ListNotes().value()[0];
    gone.deleted = true;
    ASSERT_TRUE(mission->AddNote(gone));
  }
  EXPECT_EQ(search({"#crack"}).size(), 0u);
}

}  // namespace
}  // namespace foresight
