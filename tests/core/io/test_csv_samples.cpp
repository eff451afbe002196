#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/csv_samples.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string ErrorOf(const std::string& text) {
  const auto read = ParseCsvSamples(text, "s.csv");
  if (read) return "no error";
  EXPECT_EQ(read.error().code, ErrorCode::kBadData);
  return read.error().message;
}

TEST(CsvSamples, NumbersSurviveTheRoundTripExactly) {
  const TemporaryFolder folder;
  const std::vector<CsvSample> samples = {{0, 1080, 643.1, -0.1, 1234.5}, {7, 0, 1.0 / 3, 2, 0}};
  ASSERT_TRUE(WriteCsvSamples(folder / "s.csv", samples));
  EXPECT_EQ(ReadCsvSamples(folder / "s.csv").value(), samples);
}

TEST(CsvSamples, ColumnsMayStandInAnyOrderAmongOthers) {
  const auto samples =
      ParseCsvSamples("v,note,depth_mm,beam,u,line\r\n2,hello,900,4,1,3\r\n", "s.csv");
  EXPECT_THAT(samples.value(), ElementsAre(CsvSample{3, 4, 1.0, 2.0, 900.0}));
}

TEST(CsvSamples, AHeaderAloneIsAnEmptyList) {
  EXPECT_TRUE(ParseCsvSamples("line,beam,u,v,depth_mm", "s.csv").value().empty());
}

TEST(CsvSamples, AMissingHeaderIsAnError) {
  EXPECT_EQ(ErrorOf("0,1,2,3,4\n"), "s.csv:1: the header has no column 'line'");
  EXPECT_THAT(ErrorOf(""), HasSubstr("a header is needed"));
}

TEST(CsvSamples, AColumnNamedTwiceIsAnError) {
  EXPECT_THAT(ErrorOf("line,beam,u,v,depth_mm,u\n"), HasSubstr("column 'u' twice"));
}

TEST(CsvSamples, AFaultNamesTheLineAndTheValue) {
  const std::string header = "line,beam,u,v,depth_mm\n\n0,0,0,0,1\n";
  EXPECT_EQ(ErrorOf(header + "0,0,0,0,nan\n"), "s.csv:4: depth_mm 'nan' is not a finite number");
  EXPECT_EQ(ErrorOf(header + "0,0,inf,0,1\n"), "s.csv:4: u 'inf' is not a finite number");
  EXPECT_EQ(ErrorOf(header + "0,0,0,0,-5\n"), "s.csv:4: depth_mm '-5' is negative");
  EXPECT_EQ(ErrorOf(header + "-1,0,0,0,5\n"), "s.csv:4: line '-1' is negative");
  EXPECT_EQ(ErrorOf(header + "0,1.5,0,0,5\n"), "s.csv:4: beam '1.5' is not a whole number");
  EXPECT_EQ(ErrorOf(header + "0,1,1x,0,5\n"), "s.csv:4: u '1x' is not a finite number");
  EXPECT_EQ(ErrorOf(header + "0,1,,0,5\n"), "s.csv:4: u '' is not a finite number");
  EXPECT_EQ(ErrorOf(header + "0,1,2,3\n"), "s.csv:4: the row has 4 fields, 'depth_mm' is missing");
}

}  // namespace
}  // namespace foresight
