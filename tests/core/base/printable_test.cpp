#include "core/base/printable.h"

#include <gtest/gtest.h>

namespace foresight {
namespace {

TEST(Printable, LeavesTextOfAnyLanguageAsItIs) {
  for (const std::string text :
       {"a path/with spaces.png", "Größe 5 µm", "回転", "\xf0\x9f\x94\xa7"})
    EXPECT_EQ(Printable(text), text);
}

TEST(Printable, EscapesWhatMovesATerminalsCursor) {
  EXPECT_EQ(Printable("a\x1b[2Jb"), "a\\x1b[2Jb");
  EXPECT_EQ(Printable("one\ntwo\r\tthree\x7f"), "one\\ntwo\\r\\tthree\\x7f");
  EXPECT_EQ(Printable(std::string_view("\0", 1)), "\\x00");
  // U+009B begins a command as ESC [ does.
  EXPECT_EQ(Printable("\xc2\x9b"), "\\xc2\\x9b");
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(Printable("caf\xe9.png"), "caf\\xe9.png");
  EXPECT_EQ(Printable("\xc0\xaf"), "\\xc0\\xaf");           // overlong '/'
  EXPECT_EQ(Printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // a surrogate
  EXPECT_EQ(Printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
  EXPECT_EQ(Printable("cut \xe2\x82"), "cut \\xe2\\x82");
}

TEST(Printable, SeveralLinesStaySeveral) {
  EXPECT_EQ(PrintableLines("one\ntwo\x1b"), "one\ntwo\\x1b");
}

TEST(Printable, SaysWhereTextIsNoUtf8) {
  EXPECT_EQ(FirstInvalidUtf8("Größe"), std::string_view::npos);
  EXPECT_EQ(FirstInvalidUtf8("ab\xff"), 2U);
}

}  // namespace
}  // namespace foresight
