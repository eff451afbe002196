#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/mission/line_codec.h"
#include "tests/core/mission/sample_scan.h"

namespace foresight {
namespace {

void ExpectRoundTrip(const LidarLine& line) {
  LidarLine unpacked;
  unpacked.seq = line.seq;
  unpacked.time_s = line.time_s;
  ASSERT_TRUE(UnpackLine(PackLine(line).value(), unpacked));
  EXPECT_EQ(unpacked, line);
}

TEST(LineCodec, ExtremeJumpsComeBack) {
  LidarLine line;
  line.range_mm = {0, 65535, 0, 32768, 32767, 1, 65534};
  line.intensity = {65535, 65535, 0, 1, 2, 40000, 7};
  ExpectRoundTrip(line);
}

TEST(LineCodec, ALineWithoutIntensitiesComesBackWithoutThem) {
  LidarLine line;
  line.range_mm = {1000, 1001};
  ExpectRoundTrip(line);
}

TEST(LineCodec, AnEmptyLineComesBackEmpty) {
  ExpectRoundTrip(LidarLine());
}

TEST(LineCodec, ASmoothLineTakesLessThanHalfItsBytes) {
  LidarLine line = SampleScan(1).lines[0];
  line.intensity.clear();
  // 4 mm of noise on a smooth curve is about 5 bits of 16, plus a status code now and then.
  EXPECT_LT(PackLine(line).value().bytes.size(), 2 * line.range_mm.size() / 2);
}

TEST(LineCodec, ALineIsPackedTheSameWhateverWasPackedBefore) {
  const Scan scan = SampleScan(1);
  const std::string first = PackLine(scan.lines[0]).value().bytes;
  ASSERT_TRUE(PackLine(scan.lines[1]));
  ASSERT_TRUE(PackLine(LidarLine()));
  EXPECT_EQ(PackLine(scan.lines[0]).value().bytes, first);
}

TEST(LineCodec, IntensitiesThatDoNotFitAreRefused) {
  LidarLine line;
  line.range_mm = {1, 2, 3};
  line.intensity = {1};
  EXPECT_EQ(PackLine(line).error().code, ErrorCode::kInvalidInput);
}

TEST(LineCodec, AnotherNumberOfBeamsIsDamage) {
  PackedLine packed = PackLine(SampleScan(1).lines[0]).value();
  for (const std::int64_t beams : {-1, 0, 1080, 1082, 100001}) {
    packed.beams = beams;
    LidarLine line;
    EXPECT_FALSE(UnpackLine(packed, line)) << beams;
  }
}

TEST(LineCodec, AnUnknownCodecIsNamed) {
  PackedLine packed = PackLine(SampleScan(1).lines[0]).value();
  packed.codec = static_cast<LineCodec>(9);
  LidarLine line;
  EXPECT_EQ(UnpackLine(packed, line).error().message, "line codec 9 is not known");
}

}  // namespace
}  // namespace foresight
