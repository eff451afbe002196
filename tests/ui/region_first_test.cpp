#include "ui/viewmodels/region_first.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "core/fitting/ray_set.h"
#include "tests/ui/linked_head.h"
#include "tests/ui/synthetic_scan.h"
#include "tests/ui/wait_for.h"
#include "ui/viewmodels/scan_flow.h"

namespace foresight {
namespace {

using testing::Contains;

const Scan& WholeScan() {
  static const Scan scan =
      WallAndValveScan({.from_rad = -0.26, .to_rad = 0.26, .speed_rad_s = 0.10});
  return scan;
}

/// A scan that comes over a link: every 16th line is here, as a thinned cloud.
struct RegionOfAComingScan : testing::Test {
  RegionOfAComingScan() {
    head_model.scan();
    Scan part = WholeScan();
    part.state = ScanState::kRunning;
    part.lines.clear();
    auto early = std::make_shared<EarlyScan>();
    for (std::size_t i = 0; i < WholeScan().lines.size(); i += 16) {
      part.lines.push_back(WholeScan().lines[i]);
      early->cloud_seqs.push_back(WholeScan().lines[i].seq);
    }
    early->cloud = std::make_shared<const RegisteredScan>(RegisterScan(part, {}).value());
    early->lines = early->cloud->lines;
    early->of_lines = static_cast<int>(WholeScan().lines.size());
    part.lines.clear();
    early->scan = std::make_shared<const Scan>(part);
    head->link.early = early;
  }
  bool CloudIsHere() {
    return WaitFor([&] {
      head_model.Poll();
      return session.Cloud() != nullptr;
    });
  }
  static BoxRoi AroundValve() {
    return {{Eigen::Quaterniond::Identity(), SyntheticValvePose().translation()},
            Eigen::Vector3d::Constant(0.3)};
  }

  std::shared_ptr<LinkedHead> head = std::make_shared<LinkedHead>(WholeScan().rig);
  SessionModel session{SessionMode::kLive};
  HeadViewModel head_model{head};
  ScanFlow flow{&head_model, &session};
  RegionFirst region_first{&head_model, &session, head->Link()};
};

TEST_F(RegionOfAComingScan, ItsLinesAreAskedForFirst) {
  ASSERT_TRUE(CloudIsHere());
  EXPECT_TRUE(head->link.Asked().empty());
  session.SetRoi(AroundValve());
  const RegisteredScan all = RegisterScan(WholeScan(), {}).value();
  const auto rows = RowsInRegion(all, WholeScan().rig, AroundValve());
  ASSERT_TRUE(rows.has_value());
  ASSERT_EQ(head->link.Asked().size(), 1u);
  long first = 0, last = 0;
  ASSERT_EQ(std::sscanf(head->link.Asked()[0].c_str(), "lines %ld %ld", &first, &last), 2);
  EXPECT_LE(first, WholeScan().lines[static_cast<std::size_t>(rows->first)].seq);
  EXPECT_GE(last, WholeScan().lines[static_cast<std::size_t>(rows->second)].seq);
  EXPECT_LE(last - first, rows->second - rows->first + 32) << "and hardly any others";
  session.SetRoi(std::nullopt);
  EXPECT_THAT(head->link.Asked(), Contains("lines in any order"));
}

TEST_F(RegionOfAComingScan, ARegionThatWasThereFirstIsAskedForWhenItsLinesAreKnown) {
  session.SetRoi(AroundValve());
  EXPECT_TRUE(head->link.Asked().empty());
  ASSERT_TRUE(CloudIsHere());
  EXPECT_EQ(head->link.Asked().size(), 1u);
  for (int i = 0; i < 20; ++i) head_model.Poll();
  EXPECT_EQ(head->link.Asked().size(), 1u) << "once is enough";
}

TEST(RowsInRegion, IsEmptyWhereNothingIsSeen) {
  const RegisteredScan all = RegisterScan(WholeScan(), {}).value();
  const BoxRoi behind{{Eigen::Quaterniond::Identity(), {-50.0, 0.0, 0.0}},
                      Eigen::Vector3d::Constant(0.3)};
  EXPECT_FALSE(RowsInRegion(all, WholeScan().rig, behind));
}

}  // namespace
}  // namespace foresight
