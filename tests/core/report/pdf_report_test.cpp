#include "core/report/pdf_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/io/pdf_page.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What a reader of the sheet finds on it, by poppler; empty where that is missing.
std::string TextOf(const std::string& pdf) {
  if (std::system("command -v pdftotext > /dev/null 2>&1") != 0) return "";
  const TemporaryFolder folder;
  const std::string stem = folder / "sheet";
  EXPECT_TRUE(WriteFileAtomically(stem + ".pdf", pdf));
  EXPECT_EQ(std::system(("pdftotext -layout '" + stem + ".pdf'").c_str()), 0);
  return ReadFile(stem + ".txt").value();
}

PdfReport Sheet(int rows) {
  PdfReport report;
  report.title = "Calibration of bench";
  report.verdict = "Within all limits.";
  report.good = true;
  report.subject = {{"rig", "3c1a0bac"}};
  report.tables = {{"Values", {}}};
  for (int i = 0; i < rows; ++i)
    report.tables[0].rows.push_back({fmt::format("row {}", i + 1), "0.25 deg"});
  LineChart chart;
  chart.title = "Corner residuals";
  chart.series = {{"corners", {{0.1, 0.2}, {std::nan(""), 0.0}, {-0.3, 0.1}}}};
  report.charts = {chart, LineChart()};
  return report;
}

TEST(PdfReport, HoldsVerdictSubjectChartsAndValues) {
  const auto pdf = PdfOf(Sheet(3));
  ASSERT_TRUE(pdf) << pdf.error().message;
  const std::string text = TextOf(*pdf);
  if (text.empty()) GTEST_SKIP() << "needs pdftotext (poppler-utils)";
  for (const char* wanted :
       {"Calibration of bench", "Within all limits.", "3c1a0bac", "row 3", "Corner residuals"})
    EXPECT_THAT(text, HasSubstr(wanted));
  EXPECT_THAT(text, Not(HasSubstr("more rows")));
}

TEST(PdfReport, RowsThatDoNotFitOnTheSheetAreCounted) {
  const std::string text = TextOf(PdfOf(Sheet(200)).value());
  if (text.empty()) GTEST_SKIP() << "needs pdftotext (poppler-utils)";
  EXPECT_THAT(text, HasSubstr("more rows are on the page report.html"));
}

TEST(PdfReport, TwoOfOneReportAreEqual) {
  EXPECT_EQ(PdfOf(Sheet(5)).value(), PdfOf(Sheet(5)).value());
}

TEST(PdfPage, APictureIsKeptAsAJpegInAFractionOfItsPixels) {
  Random random(1);
  ColorImage photo(1024, 768);
  for (int v = 0; v < photo.height(); ++v)
    for (int u = 0; u < photo.width(); ++u)
      photo(u, v) = {static_cast<std::uint8_t>(u / 5 + random.Index(4)),
                     static_cast<std::uint8_t>(v / 4 + random.Index(4)), 90};
  PdfPage page(100.0, 80.0);
  page.Picture(5.0, 5.0, 90.0, 67.5, photo);
  const std::string pdf = std::move(page).Bytes().value();
  EXPECT_THAT(pdf, HasSubstr("/DCTDecode"));
  EXPECT_LT(pdf.size(), 3 * photo.size() / 6);
}

}  // namespace
}  // namespace foresight
