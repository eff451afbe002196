#include "hardware/link/server/control_lease.h"

#include <gmock/gmock.h>

namespace foresight {
namespace {

using testing::HasSubstr;

TEST(ControlLease, OneOperatorHoldsIt) {
  ControlLease lease(60.0);
  const auto anna = lease.Take("anna", 0.0);
  ASSERT_TRUE(anna.granted);
  EXPECT_TRUE(lease.Holds(anna.token, 1.0));
  const auto ben = lease.Take("ben", 10.0);
  EXPECT_FALSE(ben.granted);
  EXPECT_EQ(ben.token, "");
  EXPECT_EQ(ben.holder, "anna");
  EXPECT_THAT(ben.reason, HasSubstr("anna has control"));
  EXPECT_THAT(ben.reason, HasSubstr("free in 50 s"));
  EXPECT_TRUE(lease.Holds(anna.token, 11.0));
}

TEST(ControlLease, SignsOfLifeKeepItAndSilenceEndsIt) {
  ControlLease lease(60.0);
  const std::string token = lease.Take("anna", 0.0).token;
  EXPECT_TRUE(lease.Renew(token, 59.0));
  EXPECT_TRUE(lease.Holds(token, 118.0));
  EXPECT_FALSE(lease.Holds(token, 120.0));
  EXPECT_EQ(lease.Holder(120.0), "");
  EXPECT_FALSE(lease.Renew(token, 120.0)) << "what is over does not come back by itself";
  EXPECT_TRUE(lease.Take("ben", 120.0).granted);
  EXPECT_FALSE(lease.Renew(token, 121.0));
}

TEST(ControlLease, AProgramThatWasStartedAnewTakesItsOwnLeaseAgain) {
  ControlLease lease(60.0);
  const std::string before = lease.Take("anna", 0.0).token;
  const auto again = lease.Take("anna", 1.0);
  EXPECT_TRUE(again.granted);
  EXPECT_NE(again.token, before);
  EXPECT_FALSE(lease.Holds(before, 2.0));
}

TEST(ControlLease, IsHandedOverByName) {
  ControlLease lease(60.0);
  const std::string token = lease.Take("anna", 0.0).token;
  EXPECT_FALSE(lease.HandOver("a guess", "ben", 1.0).granted);
  ASSERT_TRUE(lease.HandOver(token, "ben", 1.0).granted);
  EXPECT_TRUE(lease.Holds(token, 2.0)) << "until ben takes it";
  EXPECT_FALSE(lease.Take("carl", 3.0).granted);
  EXPECT_TRUE(lease.Take("ben", 4.0).granted);
  EXPECT_FALSE(lease.Holds(token, 4.0));
}

TEST(ControlLease, IsReleasedByItsHolderOnly) {
  ControlLease lease(60.0);
  const std::string token = lease.Take("anna", 0.0).token;
  EXPECT_FALSE(lease.Release("", 1.0).granted);
  EXPECT_TRUE(lease.Holds(token, 1.0));
  EXPECT_TRUE(lease.Release(token, 2.0).granted);
  EXPECT_EQ(lease.Holder(2.0), "");
  EXPECT_FALSE(lease.Holds("", 2.0)) << "an empty token never holds anything";
}

}  // namespace
}  // namespace foresight
