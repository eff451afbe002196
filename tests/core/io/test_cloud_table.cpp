#include "core/io/cloud_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/base/atomic_file.h"
#include "core/io/point_cloud_file.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<CloudPoint> TwoPoints() {
  CloudPoint a, b;
  a.x = 1.25f;
  a.y = -2.0f;
  a.z = 0.5f;
  a.intensity = 77.0f;
  a.line = 3;
  a.beam = 1080;
  a.time_s = 12.345678901234;
  a.color = {200, 130, 7};
  b = a;
  b.x = 9.0f;
  b.beam = 2;
  b.color = {};
  return {a, b};
}

TEST(CloudTable, WhatWasWrittenIsRead) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WritePly(folder / "c.ply", TwoPoints(), CloudFields::kWithImage, {"robot", "u", 5}));
  ASSERT_TRUE(WritePcd(folder / "c.pcd", TwoPoints(), CloudFields::kWithImage, {"robot", "u", 5}));
  for (const char* name : {"c.ply", "c.pcd"}) {
    const CloudTable table = ReadCloudTable(folder / name).value();
    ASSERT_EQ(table.points.size(), 2u) << name;
    EXPECT_EQ(table.points[0], Eigen::Vector3d(1.25, -2.0, 0.5));
    EXPECT_THAT(table.intensity, ElementsAre(77.0f, 77.0f));
    EXPECT_THAT(table.line, ElementsAre(3, 3));
    EXPECT_THAT(table.beam, ElementsAre(1080, 2));
    EXPECT_THAT(table.time_s, ElementsAre(12.345678901234, 12.345678901234));
    EXPECT_THAT(table.color, ElementsAre(Rgb8{200, 130, 7}, Rgb8{}));
    EXPECT_THAT(table.comments, testing::Contains(HasSubstr("frame robot")));
    EXPECT_EQ(table.height, 1u);
  }
}

TEST(CloudTable, AnOrganisedPcdKeepsItsRowsAndItsViewpoint) {
  const std::string pcd =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
      "3\nHEIGHT "
      "2\nVIEWPOINT 0.5 -1 2 1 0 0 0\nPOINTS 6\nDATA ascii\n"
      "1 0 0\n2 0 0\nnan nan nan\n4 0 0\n5 0 0\n6 0 0\n";
  const CloudTable table = DecodePcdTable(pcd, "c.pcd").value();
  EXPECT_EQ(table.width, 3u);
  EXPECT_EQ(table.height, 2u);
  EXPECT_EQ(table.viewpoint, Eigen::Vector3d(0.5, -1.0, 2.0));
  EXPECT_TRUE(std::isnan(table.points[2].x()));
}

TEST(CloudTable, APackedColourKeepsItsBitsAlsoWhereTheyAreNoNumber) {
  // As a float 0xff800001 is a NaN that says so, whose bits a computation would change.
  std::string pcd =
      "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT "
      "1\nPOINTS 1\nDATA binary\n";
  const float xyz[3] = {1.0f, 2.0f, 3.0f};
  const std::uint32_t bits = 0xff800001;
  pcd.append(reinterpret_cast<const char*>(xyz), 12);
  pcd.append(reinterpret_cast<const char*>(&bits), 4);
  EXPECT_THAT(DecodePcdTable(pcd, "c.pcd")->color, ElementsAre(Rgb8{0x80, 0, 1}));
}

TEST(CloudTable, TimeInWholeNanosecondsBecomesSeconds) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty uint t\nproperty uchar ring\nend_header\n1 2 3 500000000 7\n1 2 4 0 8\n";
  const CloudTable table = DecodePlyTable(ply, "c.ply").value();
  EXPECT_THAT(table.time_s, ElementsAre(0.5, 0.0));
  EXPECT_THAT(table.ring, ElementsAre(7, 8));
}

TEST(CloudTable, TextIsReadWithCommentsAndCommas) {
  const CloudTable table = DecodeTextTable("# x y z i\n1, 2, 3, 40\n\n4;5;6;50\n", "c.csv").value();
  EXPECT_THAT(table.points, ElementsAre(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6)));
  EXPECT_THAT(table.intensity, ElementsAre(40.0f, 50.0f));
}

TEST(CloudTable, AFileOf3dtkIsTurnedToMetresAheadLeftAndUp) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "scan000.3d", "100 50 700\n"));
  // 3DTK: 1 m to the right, 0.5 m up, 7 m ahead.
  const CloudTable table = ReadCloudTable(folder / "scan000.3d").value();
  EXPECT_TRUE(table.points[0].isApprox(Eigen::Vector3d(7.0, -1.0, 0.5), 1e-12));
}

TEST(CloudTable, ATextsFirstLineMayNameItsColumns) {
  const auto table = DecodeTextTable(
      "\"laser_id\",X,Y,Z,Intensity,t\n3,1,2,0.5,40,1000\n4,5,6,0.5,dim,2000\n", "c.csv");
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_EQ(table->points.size(), 2u);
  EXPECT_EQ(table->points[1], Eigen::Vector3d(5.0, 6.0, 0.5));
  EXPECT_EQ(table->intensity[0], 40.0f);
  EXPECT_TRUE(std::isnan(table->intensity[1]));
  EXPECT_NEAR(table->time_s[1], 2e-6, 1e-15);
  // CloudCompare's.
  const auto compare = DecodeTextTable("//X Y Z R G B\n1 2 3 10 20 255\n", "c.txt");
  ASSERT_TRUE(compare) << compare.error().message;
  EXPECT_THAT(compare->color, ElementsAre(Rgb8{10, 20, 255}));
  const auto no_height = DecodeTextTable("x,y,height\n1,2,3\n", "c.csv");
  ASSERT_FALSE(no_height);
  EXPECT_THAT(no_height.error().message, HasSubstr("no number 'z'"));
  // As Excel and Windows write it.
  const auto marked = DecodeTextTable("\xEF\xBB\xBFx,y,z\r\n1,2,3\r\n", "c.csv");
  ASSERT_TRUE(marked) << marked.error().message;
  EXPECT_EQ(marked->points[0], Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(CloudTable, ATextsHeaderWithoutPointsOrWithAnIndexColumnIsRefused) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "none.csv", "x,y,z\n"));
  ASSERT_TRUE(WriteFileAtomically(folder / "index.csv", ",x,y,z\n0,1,2,3\n"));
  EXPECT_THAT(ReadCloudTable(folder / "none.csv").error().message, HasSubstr("none of its 0"));
  EXPECT_THAT(ReadCloudTable(folder / "index.csv").error().message,
              HasSubstr("names 3 columns, the next one has 4 numbers"));
}

TEST(CloudTable, AWordThatIsNoNumberChangesNoOtherNumberOfATextsColumn) {
  const auto table =
      DecodeTextTable("x,y,z,t,r,g,b\n1,2,3,1000,255,0,0\n1,2,4,-,nan,12.5,1\n", "c.csv");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_NEAR(table->time_s[0], 1e-6, 1e-15);
  EXPECT_THAT(table->color, ElementsAre(Rgb8{255, 0, 0}, Rgb8{0, 12, 1}));
  const auto bright = DecodeTextTable("x,y,z,r,g,b\n1,2,3,1,0.5,0\n", "c.csv");
  ASSERT_TRUE(bright) << bright.error().message;
  EXPECT_THAT(bright->color, ElementsAre(Rgb8{255, 127, 0}));
}

TEST(CloudTable, FarPointsInMillimetresAreNear) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "mm.xyz", "250000 0 0\n"));
  EXPECT_FALSE(ReadCloudTable(folder / "mm.xyz"));
  const auto table = ReadCloudTable(folder / "mm.xyz", 0.001);
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_NEAR(table->points[0].x(), 250.0, 1e-9);
}

TEST(CloudTable, WhatIsNoCloudIsRefusedByName) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a.xyz", "1 2\n"));
  ASSERT_TRUE(WriteFileAtomically(folder / "b.xyz", "1 2 x\n"));
  ASSERT_TRUE(WriteFileAtomically(folder / "c.las", "LASF"));
  ASSERT_TRUE(WriteFileAtomically(folder / "d.xyz", "nan nan nan\n"));
  ASSERT_TRUE(WriteFileAtomically(folder / "e.xyz", "1e9 0 0\n"));
  const auto why = [&](const char* name) { return ReadCloudTable(folder / name).error().message; };
  EXPECT_THAT(why("a.xyz"), HasSubstr("2 columns in its first line"));
  EXPECT_THAT(why("b.xyz"), HasSubstr("'x' is not a number"));
  EXPECT_THAT(why("c.las"), HasSubstr("is no point cloud"));
  EXPECT_THAT(why("d.xyz"), HasSubstr("none of its 1 points is a number"));
  EXPECT_THAT(why("e.xyz"), HasSubstr("beyond 100 km"));
  for (const char* name : {"a.xyz", "b.xyz", "c.las", "d.xyz", "e.xyz"})
    EXPECT_THAT(why(name), HasSubstr(name));
}

TEST(CloudTable, AWordThatIsNoNumberIsAnErrorInACoordinateOnly) {
  const std::string header =
      "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
      "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n";
  const auto table = DecodePcdTable(header + "1 2 3 40\n1 2 4 dim\n", "dim.pcd");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->intensity[0], 40.0f);
  EXPECT_TRUE(std::isnan(table->intensity[1]));
  EXPECT_FALSE(DecodePcdTable(header + "1 2 3 40\n1 2 far 40\n", "far.pcd"));
}

}  // namespace
}  // namespace foresight
