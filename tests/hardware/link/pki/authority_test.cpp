#include "hardware/link/pki/authority.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/support/link_keys.h"

namespace foresight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

constexpr std::int64_t kNow = 1'790'000'000;  // September 2026

unsigned ModeOf(const std::filesystem::path& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0) << path;
  return status.st_mode & 07777;
}

TEST(CertificateAuthority, PrivateKeysAreReadableByTheirOwnerOnly) {
  LinkKeys keys(kNow);
  EXPECT_EQ(ModeOf(keys.ca().folder() / "ca.key"), 0600u);
  EXPECT_EQ(ModeOf(keys.Head() / kPrivateKeyFile), 0600u);
  EXPECT_EQ(ModeOf(keys.Operator() / kPrivateKeyFile), 0600u);
  EXPECT_EQ(ModeOf(keys.ca().folder()), 0700u);
}

TEST(CertificateAuthority, ACaIsNeverOverwritten) {
  LinkKeys keys(kNow);
  const std::string before = keys.Keys().private_key_pem;
  const auto folder = keys.ca().folder();
  { const CertificateAuthority closed = std::move(keys.ca()); }
  const auto again = CertificateAuthority::Create(folder, kDaysOfCa, kNow);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kState);
  EXPECT_EQ(ReadFile(folder / "ca.key").value(), before);
}

TEST(CertificateAuthority, OneProgramAtATimeWorksWithIt) {
  LinkKeys keys(kNow);
  const auto second = CertificateAuthority::Open(keys.ca().folder());
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("another program works with this CA"));
}

TEST(CertificateAuthority, OpenedAgainItKnowsWhatItIssuedAndRevoked) {
  LinkKeys keys(kNow);
  keys.Head();
  keys.Operator();
  ASSERT_TRUE(keys.ca().Revoke("anna", kNow));
  const auto folder = keys.ca().folder();
  { const CertificateAuthority closed = std::move(keys.ca()); }
  const auto again = CertificateAuthority::Open(folder);
  ASSERT_TRUE(again) << again.error().message;
  const auto all = again->List().value();
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[0].certificate.identity, (LinkIdentity{LinkRole::kOperator, "anna"}));
  EXPECT_TRUE(all[0].revoked);
  EXPECT_EQ(all[1].certificate.identity, (LinkIdentity{LinkRole::kHead, "left"}));
  EXPECT_TRUE(all[1].current);
}

TEST(CertificateAuthority, AHeadHasItsAddressesAndAStableName) {
  LinkKeys keys(kNow);
  const auto head = keys.ca().Issue({LinkRole::kHead, "left"},
                                    {{"10.0.0.2", "fd00::2", "head.local"}, 30, false}, kNow);
  ASSERT_TRUE(head) << head.error().message;
  EXPECT_THAT(head->addresses, ElementsAre("left.foresight.internal", "10.0.0.2",
                                           "fd00:0:0:0:0:0:0:2", "head.local"));
  EXPECT_EQ(head->to_utc_s, kNow + 30 * kDayS);
  EXPECT_EQ(head->from_utc_s, kNow - kDayS);  // a clock that is a day behind takes it
}

TEST(CertificateAuthority, SerialNumbersAreRandomAndLong) {
  LinkKeys keys(kNow);
  keys.Operator("a");
  keys.Operator("b");
  const auto all = keys.ca().List().value();
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_NE(all[0].certificate.serial, all[1].certificate.serial);
  EXPECT_THAT(all[0].certificate.serial, SizeIs(32));  // 127 bits, the uppermost is set
}

TEST(CertificateAuthority, ANameThatIsTakenIsRefusedAndItsKeyStays) {
  LinkKeys keys(kNow);
  const auto folder = keys.Operator();
  const std::string key = ReadFile(folder / kPrivateKeyFile).value();
  const auto again = keys.ca().Issue({LinkRole::kObserver, "anna"}, {{}, 30, false}, kNow);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::kState);
  EXPECT_THAT(again.error().message, HasSubstr("anna: is the name of the operator anna already"));
  EXPECT_EQ(ReadFile(folder / kPrivateKeyFile).value(), key);
}

TEST(CertificateAuthority, WhoAsksForItGetsANewKeyAndTheOldOneIsRevoked) {
  LinkKeys keys(kNow);
  const auto folder = keys.Operator();
  const std::string key = ReadFile(folder / kPrivateKeyFile).value();
  const std::string serial = keys.ca().List().value()[0].certificate.serial;
  ASSERT_TRUE(keys.ca().Issue({LinkRole::kOperator, "anna"}, {{}, 30, true}, kNow));
  EXPECT_NE(ReadFile(folder / kPrivateKeyFile).value(), key);
  EXPECT_TRUE(keys.ca().revocations().Contains(serial));
  EXPECT_TRUE(LoadTlsFiles(folder, kNow));
}

TEST(CertificateAuthority, ARequestThatCannotBeSignedRevokesNothing) {
  LinkKeys keys(kNow);
  keys.Head();
  const auto bad = keys.ca().Issue({LinkRole::kHead, "left"}, {{"10.0.0.256"}, 30, true}, kNow);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::kInvalidOptions);
  EXPECT_TRUE(keys.ca().revocations().serials.empty());
  EXPECT_TRUE(LoadTlsFiles(keys.folder("left"), kNow));
}

TEST(CertificateAuthority, RenewingKeepsTheKeyAndTheAddresses) {
  LinkKeys keys(kNow);
  const auto folder = keys.Head("left", {"10.0.0.2", "head.local"});
  const std::string key = ReadFile(folder / kPrivateKeyFile).value();
  const auto later = kNow + 700 * kDayS;
  const auto renewed = keys.ca().Renew("left", {}, later);
  ASSERT_TRUE(renewed) << renewed.error().message;
  EXPECT_EQ(ReadFile(folder / kPrivateKeyFile).value(), key);
  EXPECT_THAT(renewed->addresses, ElementsAre("left.foresight.internal", "10.0.0.2", "head.local"));
  EXPECT_TRUE(LoadTlsFiles(folder, kNow + 1400 * kDayS));
  const auto all = keys.ca().List().value();
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_FALSE(all[0].current);
  EXPECT_TRUE(all[1].current);
}

TEST(CertificateAuthority, TheLatestIsCurrentAlsoWithinOneSecondAndWithAnEarlierEnd) {
  LinkKeys keys(kNow);
  keys.Head("left", {"10.0.0.2"});
  for (const char* address : {"10.0.0.3", "10.0.0.4", "10.0.0.5"})
    ASSERT_TRUE(keys.ca().Renew("left", {{address}, 30}, kNow));
  const auto all = keys.ca().List().value();
  ASSERT_THAT(all, SizeIs(4));
  EXPECT_TRUE(all[3].current);
  EXPECT_THAT(all[3].certificate.addresses, ElementsAre("left.foresight.internal", "10.0.0.5"));
  EXPECT_EQ(keys.ca().Renew("left", {{}, 30}, kNow)->addresses, all[3].certificate.addresses);
}

TEST(CertificateAuthority, RevokingANameRevokesWhatWasRenewedToo) {
  LinkKeys keys(kNow);
  const auto folder = keys.Operator();
  ASSERT_TRUE(keys.ca().Renew("anna", {}, kNow + kDayS));
  EXPECT_EQ(keys.ca().Revoke("anna", kNow + 2 * kDayS).value(), 2);
  const auto all = keys.ca().List().value();
  for (const auto& issued : all) EXPECT_TRUE(issued.revoked);
  EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST(CertificateAuthority, ANewListReachesTheFoldersOfAllMachines) {
  LinkKeys keys(kNow);
  const auto head = keys.Head();
  keys.Operator();
  ASSERT_TRUE(keys.ca().Revoke("anna", kNow));
  const auto list = ReadRevocationList(ReadFile(head / kRevocationsFile).value(),
                                       keys.Keys().certificate_pem, "list");
  ASSERT_TRUE(list) << list.error().message;
  EXPECT_THAT(list->serials, SizeIs(1));
  EXPECT_EQ(list->number, keys.ca().revocations().number);
}

TEST(CertificateAuthority, ANameThatIsNotThereCannotBeRenewedOrRevoked) {
  LinkKeys keys(kNow);
  EXPECT_EQ(keys.ca().Renew("anna", {}, kNow).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(keys.ca().Revoke("../machines", kNow).error().code, ErrorCode::kInvalidInput);
}

TEST(CertificateAuthority, NoCertificateOutlivesTheCa) {
  LinkKeys keys(kNow);
  const auto late =
      keys.ca().Issue({LinkRole::kOperator, "anna"}, {}, kNow + (kDaysOfCa - 100) * kDayS);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::kInvalidOptions);
  EXPECT_THAT(late.error().message, HasSubstr("--days: 730 is not between 1 and 100"));
}

TEST(CertificateAuthority, ARecordThatIsDamagedIsNamed) {
  LinkKeys keys(kNow);
  ASSERT_TRUE(WriteFileAtomically(keys.ca().folder() / "certificates/bad.crt", "nothing"));
  const auto all = keys.ca().List();
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().message, HasSubstr("certificates/bad.crt: holds no certificate"));
}

class BadAddress : public testing::TestWithParam<const char*> {};
TEST_P(BadAddress, IsRefused) {
  LinkKeys keys(kNow);
  const auto head = keys.ca().Issue({LinkRole::kHead, "left"}, {{GetParam()}, 30, false}, kNow);
  ASSERT_FALSE(head);
  EXPECT_THAT(head.error().message, HasSubstr("is neither an IP address nor a host name"));
}
INSTANTIATE_TEST_SUITE_P(Addresses, BadAddress,
                         testing::Values("", "10.0.0.2:7411", "[fd00::2]", "two words", "a..b",
                                         "-a", "10.0.0.256", "*.local", "a/b"));

class BadName : public testing::TestWithParam<const char*> {};
TEST_P(BadName, IsRefusedForAHead) {
  LinkKeys keys(kNow);
  EXPECT_EQ(keys.ca().Issue({LinkRole::kHead, GetParam()}, {{"h"}, 30, false}, kNow).error().code,
            ErrorCode::kInvalidOptions);
}
INSTANTIATE_TEST_SUITE_P(Names, BadName,
                         testing::Values("", ".", "..", "../x", "a/b", "Left", "a:b", "a b", "-a",
                                         "a-", "a.b", "a2345678901234567890123456789012345678901"));

}  // namespace
}  // namespace foresight
