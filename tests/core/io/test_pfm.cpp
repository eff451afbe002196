#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/atomic_file.h"
#include "core/io/pfm.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// The message of the error that reading `bytes` gives.
std::string ErrorOf(const TemporaryFolder& folder, const std::string& bytes) {
  EXPECT_TRUE(WriteFileAtomically(folder / "bad.pfm", bytes));
  const auto read = ReadPfm(folder / "bad.pfm");
  if (read) return "no error";
  EXPECT_EQ(read.error().code, ErrorCode::kBadData);
  EXPECT_THAT(read.error().message, HasSubstr("bad.pfm: "));
  return read.error().message;
}

TEST(Pfm, TheFirstRowOfTheFileIsTheBottomOne) {
  const TemporaryFolder folder;
  const std::string one("\0\0\x80\x3f", 4), two("\0\0\0\x40", 4);
  ASSERT_TRUE(WriteFileAtomically(folder / "a.pfm", "Pf\n1 2\n-1.0\n" + one + two));
  const FloatImage image = ReadPfm(folder / "a.pfm").value();
  EXPECT_THAT(image.values(), testing::ElementsAre(2.0f, 1.0f));
}

TEST(Pfm, APositiveScaleMeansBigEndFirst) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a.pfm", "Pf 1 1 1\n" + std::string("\x3f\x80\0\0", 4)));
  EXPECT_EQ(ReadPfm(folder / "a.pfm").value()(0, 0), 1.0f);
}

TEST(Pfm, InfinityAndNanSurviveTheRoundTrip) {
  const TemporaryFolder folder;
  FloatImage image(3, 2, 1.5f);
  image(0, 0) = std::numeric_limits<float>::infinity();
  image(1, 1) = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(WritePfm(folder / "a.pfm", image));
  const FloatImage read = ReadPfm(folder / "a.pfm").value();
  EXPECT_EQ(read(0, 0), image(0, 0));
  EXPECT_TRUE(std::isnan(read(1, 1)));
  EXPECT_EQ(read(2, 1), 1.5f);
}

TEST(Pfm, AColorMapIsRefusedByName) {
  EXPECT_THAT(ErrorOf(TemporaryFolder(), "PF\n1 1\n-1\n............"), HasSubstr("colour"));
}

TEST(Pfm, MissingPixelsAreCounted) {
  EXPECT_THAT(ErrorOf(TemporaryFolder(), "Pf\n2 2\n-1\n..............."),
              HasSubstr("need 16 bytes, the file has 15"));
}

TEST(Pfm, AnAbsurdSizeIsRefused) {
  const TemporaryFolder folder;
  for (const char* size : {"0 1", "-3 1", "20001 1", "1 99999999999999", "1.5 1", "x 1"})
    EXPECT_THAT(ErrorOf(folder, std::string("Pf\n") + size + "\n-1\n"), HasSubstr("size '"))
        << size;
}

TEST(Pfm, AScaleThatIsNoNumberIsRefused) {
  const TemporaryFolder folder;
  for (const char* scale : {"0", "nan", "inf", "abc", ""})
    EXPECT_THAT(ErrorOf(folder, std::string("Pf\n1 1\n") + scale + "\n...."), HasSubstr("scale"))
        << scale;
}

TEST(Pfm, AnEmptyFileIsNotAFloatMap) {
  EXPECT_THAT(ErrorOf(TemporaryFolder(), ""), HasSubstr("does not start with 'Pf'"));
}

TEST(Pfm, ReadsAMiddleburyDisparityMap) {
  const std::filesystem::path path =
      std::filesystem::path(FORESIGHT_TEST_DATA) / "middlebury/Teddy/disp0GT.pfm";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs FORESIGHT_TEST_DATA: " << path;
  const FloatImage image = ReadPfm(path).value();
  int finite = 0;
  for (const float value : image.values())
    if (std::isfinite(value)) ++finite;
  // Middlebury marks unknown disparities with infinity; most of a map is known.
  EXPECT_GT(finite, static_cast<int>(image.size() / 2));
}

}  // namespace
}  // namespace foresight
