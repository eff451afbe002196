#include "core/mission/scan_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/provenance.h"
#include "tests/core/mission/sample_scan.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

/// Lines 0 to 6 and 9 to 21: 7 and 8 were lost.
const Scan kScan = SampleScan(1);

Scan With(const std::vector<std::size_t>& rows) {
  Scan scan = kScan;
  scan.lines.clear();
  for (const std::size_t row : rows) scan.lines.push_back(kScan.lines.Share(row));
  return scan;
}

TEST(ScanPart, NamesItsLinesByRunsOfThem) {
  const ScanPart part = PartOf(With({0, 1, 2, 6, 7, 8, 19}), 20);
  EXPECT_EQ(part.lines, 7);
  EXPECT_EQ(part.of_lines, 20);
  EXPECT_THAT(part.seqs, ElementsAre(Pair(0, 2), Pair(6, 6), Pair(9, 10), Pair(21, 21)));
}

TEST(ScanPart, IsTakenFromTheWholeScanAgain) {
  for (const auto& rows :
       {std::vector<std::size_t>{0, 1, 2, 6, 7, 8, 19}, {3}, {0, 2, 4, 6, 8, 10}, {}}) {
    const Scan part = With(rows);
    const auto taken = TakePart(kScan, PartOf(part, 20));
    ASSERT_TRUE(taken) << taken.error().message;
    EXPECT_EQ(taken->lines, part.lines);
    EXPECT_EQ(taken->track.samples().size(), kScan.track.samples().size());
  }
}

TEST(ScanPart, IsRefusedWhereLinesAreMissing) {
  const auto taken = TakePart(With({0, 1, 2}), PartOf(With({0, 1, 2, 3}), 20));
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().code, ErrorCode::kInvalidInput);
  EXPECT_THAT(taken.error().message, HasSubstr("made from 4 lines"));
}

TEST(ScanPart, StandsInTheProvenance) {
  Provenance provenance;
  provenance.part = PartOf(With({0, 1, 6, 7}), 20);
  const auto back = ProvenanceFromJson(ProvenanceToJson(provenance), "here");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->part, provenance.part);
  provenance.part.reset();
  const std::string whole = ProvenanceToJson(provenance);
  EXPECT_EQ(whole.find("part"), std::string::npos) << "files of earlier programs look the same";
  EXPECT_FALSE(ProvenanceFromJson(whole, "here")->part.has_value());
}

TEST(ScanPart, ThatIsOutOfOrderIsRefused) {
  Provenance provenance;
  for (const auto& seqs : {std::vector<std::pair<std::int64_t, std::int64_t>>{{5, 4}},
                           {{0, 3}, {3, 5}},
                           {{4, 5}, {0, 1}},
                           {{-3, 1}}}) {
    provenance.part = ScanPart{seqs, 2, 20};
    const auto back = ProvenanceFromJson(ProvenanceToJson(provenance), "here");
    ASSERT_FALSE(back);
    EXPECT_EQ(back.error().code, ErrorCode::kBadData);
    EXPECT_THAT(back.error().message, HasSubstr("out of order"));
  }
}

}  // namespace
}  // namespace foresight
