#include "core/report/comparison_page.h"

#include <gtest/gtest.h>

#include "core/base/atomic_file.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

ComparisonPage TwoAlternatives() {
  ComparisonPage page;
  page.title = "Title";
  page.header = {"scene", "A80"};
  page.rows = {{"a <scene>", "1.5"}};
  page.sections = {{"a <scene>",
                    {{"one", "note", {{"a-one.png", "first"}, {"a-one-2.png", "second"}}},
                     {"two", "", {{"a-two.png", "only"}}}}}};
  return page;
}

std::string Written(const ComparisonPage& page) {
  const TemporaryFolder folder;
  EXPECT_TRUE(WriteComparisonPage(page, folder / "index.html"));
  return ReadFile(folder / "index.html").value_or("");
}

std::size_t At(const std::string& html, const std::string& part) {
  const std::size_t at = html.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at;
}

TEST(ComparisonPage, SetsTheSameRowOfAllColumnsSideBySide) {
  const std::string html = Written(TwoAlternatives());
  EXPECT_LT(At(html, "a-one.png"), At(html, "a-two.png"));
  EXPECT_LT(At(html, "a-two.png"), At(html, "a-one-2.png"));
  EXPECT_LT(At(html, "a-one-2.png"), At(html, "<td class=\"empty\">"));
}

TEST(ComparisonPage, EscapesWhatComesFromOutside) {
  const std::string html = Written(TwoAlternatives());
  EXPECT_EQ(html.find("<scene>"), std::string::npos);
  EXPECT_NE(html.find("<td>a &lt;scene&gt;</td><td class=\"number\">1.5</td>"), std::string::npos);
}

TEST(ComparisonPage, SaysWhereItCannotBeWritten) {
  const TemporaryFolder folder;
  const auto status = WriteComparisonPage(TwoAlternatives(), folder / "missing" / "index.html");
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("index.html"), std::string::npos);
}

}  // namespace
}  // namespace foresight
