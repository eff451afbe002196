// A folder of keys as programs load it and as `foresightctl pki check` looks at it.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "hardware/link/pki/check_key_folder.h"
#include "tests/support/link_keys.h"

namespace foresight {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kFolderNow = 1'790'000'000;

class KeyFolder : public testing::Test {
 protected:
  std::string Check(std::int64_t utc_s = kFolderNow) const {
    const auto report = CheckKeyFolder(folder_, utc_s);
    EXPECT_TRUE(report) << report.error().message;
    std::string text = report->IsUsable() ? "usable" : "unusable";
    for (const KeyFinding& finding : report->findings)
      if (finding.kind != KeyFinding::Kind::kGood) text += "; " + finding.text;
    return text;
  }

  LinkKeys keys_{kFolderNow};
  std::filesystem::path folder_ = keys_.Head();
};

TEST_F(KeyFolder, AsItWasMadeIsUsable) {
  EXPECT_EQ(Check(), "usable");
  const auto files = LoadTlsFiles(folder_, kFolderNow);
  ASSERT_TRUE(files) << files.error().message;
  EXPECT_EQ(files->certificate.identity, (LinkIdentity{LinkRole::kHead, "left"}));
}

TEST_F(KeyFolder, OfAHeadIsNoneForAStationAndTheOtherWayRound) {
  const auto anna = keys_.Operator();
  EXPECT_TRUE(LoadTlsFilesOfHead(folder_, kFolderNow));
  EXPECT_TRUE(LoadTlsFilesOfStation(anna, kFolderNow));
  EXPECT_TRUE(LoadTlsFilesOfStation(keys_.Observer(), kFolderNow));
  EXPECT_THAT(LoadTlsFilesOfStation(folder_, kFolderNow).error().message,
              HasSubstr("link.crt: is of the head left; a station needs the keys of a person"));
  EXPECT_THAT(LoadTlsFilesOfHead(anna, kFolderNow).error().message,
              HasSubstr("link.crt: is of the operator anna; a head needs the keys of a head"));
}

TEST_F(KeyFolder, AKeyThatOthersMayReadIsRefused) {
  ASSERT_EQ(chmod((folder_ / kPrivateKeyFile).c_str(), 0644), 0);
  EXPECT_THAT(Check(), HasSubstr("others may read this private key (permissions 644)"));
  EXPECT_FALSE(LoadTlsFiles(folder_, kFolderNow));
}

TEST_F(KeyFolder, AKeyOfAnotherCertificateIsRefused) {
  ASSERT_TRUE(WritePrivateFile(folder_ / kPrivateKeyFile, MakePrivateKey().value()));
  EXPECT_THAT(Check(), HasSubstr("link.key: is not the key of the certificate beside it"));
  EXPECT_FALSE(LoadTlsFiles(folder_, kFolderNow));
}

TEST_F(KeyFolder, ACertificateOfAnotherCaIsRefused) {
  LinkKeys foreign(kFolderNow);
  ASSERT_TRUE(WriteFileAtomically(folder_ / kCaFile, foreign.Keys().certificate_pem));
  EXPECT_THAT(Check(), HasSubstr("link.crt: signed by another CA"));
  EXPECT_FALSE(LoadTlsFiles(folder_, kFolderNow));
}

TEST_F(KeyFolder, EachFileThatIsMissingIsNamed) {
  for (const char* file : {kCaFile, kCertificateFile, kPrivateKeyFile, kRevocationsFile}) {
    const auto path = folder_ / file;
    std::filesystem::rename(path, keys_ / "away");
    EXPECT_THAT(Check(), HasSubstr(path.string() + ": cannot open"));
    std::filesystem::rename(keys_ / "away", path);
  }
  EXPECT_EQ(CheckKeyFolder(folder_ / "none", kFolderNow).error().code, ErrorCode::kIo);
}

TEST_F(KeyFolder, WarnsAMonthBeforeTheEndAndIsRefusedAfterIt) {
  const std::int64_t end = kFolderNow + kDaysOfCertificate * kDayS;
  EXPECT_EQ(Check(end - 31 * kDayS), "usable");
  EXPECT_THAT(Check(end - 29 * kDayS), HasSubstr("usable; link.crt: ends on 2028-09-20"));
  EXPECT_THAT(Check(end + 1), HasSubstr("unusable; link.crt: expired on 2028-09-20"));
  EXPECT_THAT(LoadTlsFiles(folder_, end + 1).error().message, HasSubstr("expired on 2028-09-20"));
}

TEST_F(KeyFolder, SaysThatTheCertificateWasRevoked) {
  const std::string own = ReadFile(folder_ / kCertificateFile).value();
  ASSERT_TRUE(keys_.ca().Issue({LinkRole::kHead, "left"}, {{"h"}, 30, true}, kFolderNow));
  ASSERT_TRUE(WriteFileAtomically(folder_ / kCertificateFile, own));
  EXPECT_THAT(Check(), HasSubstr("link.crt: was revoked"));
}

TEST_F(KeyFolder, SaysWhenTheListIsOverdue) {
  ASSERT_TRUE(keys_.ca().MakeRevocationsAnew(10, kFolderNow));
  EXPECT_THAT(Check(kFolderNow + 11 * kDayS), HasSubstr("usable; ca.crl: was to be made anew by"));
}

TEST(KeyFolders, OfAStationFollowTheConfigurationsFolder) {
  const char* before = std::getenv("XDG_CONFIG_HOME");
  const std::string kept = before == nullptr ? "" : before;
  setenv("XDG_CONFIG_HOME", "/somewhere", 1);
  EXPECT_EQ(KeyFolderOfStation(), "/somewhere/foresight/link");
  setenv("XDG_CONFIG_HOME", "relative", 1);
  EXPECT_EQ(KeyFolderOfStation(),
            std::filesystem::path(std::getenv("HOME")) / ".config/foresight/link");
  if (before == nullptr)
    unsetenv("XDG_CONFIG_HOME");
  else
    setenv("XDG_CONFIG_HOME", kept.c_str(), 1);
  EXPECT_EQ(KeyFolderOfHead(), "/etc/foresight/link");
}

}  // namespace
}  // namespace foresight
