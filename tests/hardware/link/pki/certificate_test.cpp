#include "hardware/link/pki/certificate.h"

#include <gmock/gmock.h>

#include "tests/support/link_keys.h"

namespace foresight {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kIssueNow = 1'790'000'000;

class Certificate : public testing::Test {
 protected:
  std::string Pem(const std::filesystem::path& folder) const {
    return ReadFile(folder / kCertificateFile).value();
  }
  Status Check(const std::filesystem::path& folder, LinkRole role, std::int64_t utc_s = kIssueNow) {
    return CheckSignedBy(keys_.Keys().certificate_pem, Pem(folder), role, utc_s, "peer");
  }

  LinkKeys keys_{kIssueNow};
};

TEST_F(Certificate, SaysRoleAndName) {
  EXPECT_EQ(ReadLinkCertificate(Pem(keys_.Observer()), "peer")->identity,
            (LinkIdentity{LinkRole::kObserver, "otto"}));
}

TEST_F(Certificate, OfAnOperatorIsNoneOfAServerAndOfAHeadNoneOfAClient) {
  const auto head = keys_.Head();
  const auto anna = keys_.Operator();
  EXPECT_TRUE(Check(head, LinkRole::kHead));
  EXPECT_TRUE(Check(anna, LinkRole::kOperator));
  EXPECT_FALSE(Check(head, LinkRole::kOperator));
  EXPECT_FALSE(Check(anna, LinkRole::kHead));
}

TEST_F(Certificate, HoldsBetweenItsDatesOnly) {
  const auto anna = keys_.Operator();
  EXPECT_TRUE(Check(anna, LinkRole::kOperator, kIssueNow + kDaysOfCertificate * kDayS - 1));
  const auto late = Check(anna, LinkRole::kOperator, kIssueNow + kDaysOfCertificate * kDayS + 1);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().message, "peer: expired on 2028-09-20");
  keys_.Rewrite(anna, {LinkRole::kOperator, "anna"}, {kIssueNow + 3600, kIssueNow + kDayS});
  const auto early = Check(anna, LinkRole::kOperator);
  ASSERT_FALSE(early);
  EXPECT_THAT(early.error().message, HasSubstr("not valid before 2026-09-21"));
}

TEST_F(Certificate, OfAnotherCaIsRefused) {
  LinkKeys foreign(kIssueNow);
  const auto status = Check(foreign.Operator(), LinkRole::kOperator);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "peer: signed by another CA");
}

TEST_F(Certificate, OfTheCaItselfIsNoneOfTheLink) {
  EXPECT_FALSE(ReadLinkCertificate(keys_.Keys().certificate_pem, "peer"));
}

TEST_F(Certificate, AnOperatorsCertificateCannotSignAnother) {
  const auto anna = keys_.Operator();
  const KeyPair as_ca{Pem(anna), ReadFile(anna / kPrivateKeyFile).value()};
  const auto eve = SignCertificate({{LinkRole::kOperator, "eve"},
                                    {},
                                    {kIssueNow, kIssueNow + kDayS},
                                    PublicKeyOf(as_ca.private_key_pem).value()},
                                   as_ca);
  ASSERT_TRUE(eve) << eve.error().message;
  EXPECT_FALSE(
      CheckSignedBy(keys_.Keys().certificate_pem, *eve, LinkRole::kOperator, kIssueNow, "eve"));
  EXPECT_FALSE(CheckSignedBy(as_ca.certificate_pem, *eve, LinkRole::kOperator, kIssueNow, "eve"));
  EXPECT_FALSE(ReadCaCertificate(as_ca.certificate_pem, "ca.crt"));
}

TEST_F(Certificate, AByteThatWasChangedBreaksIt) {
  std::string pem = Pem(keys_.Operator());
  const std::size_t middle = pem.size() / 2;
  pem[middle] = pem[middle] == 'A' ? 'B' : 'A';
  EXPECT_FALSE(
      CheckSignedBy(keys_.Keys().certificate_pem, pem, LinkRole::kOperator, kIssueNow, "peer"));
}

TEST_F(Certificate, IdentitiesAreReadBackAndNothingElseIs) {
  const LinkIdentity anna{LinkRole::kOperator, "Anna_B.2"};
  EXPECT_EQ(LinkIdentity::FromUri(anna.ToUri()), anna);
  for (const char* uri : {"", "foresight:", "foresight:operator",
                          "foresight:operator:", "foresight:root:anna", "foresight:operator:a/b",
                          "foresight:head:Left", "https://operator:anna", "foresight:operator:a:b"})
    EXPECT_FALSE(LinkIdentity::FromUri(uri)) << uri;
}

TEST(DateText, ReachesTheYearsThatCertificatesCanSay) {
  EXPECT_EQ(DateText(253'402'300'799), "9999-12-31");
  EXPECT_EQ(DateText(-1), "1969-12-31");
}

}  // namespace
}  // namespace foresight
