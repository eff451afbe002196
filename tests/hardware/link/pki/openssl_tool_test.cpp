// The program `openssl` as a judge of the files that the CA makes.
#include <gmock/gmock.h>

#include "tests/support/link_keys.h"
#include "tests/support/run_program.h"

namespace foresight {
namespace {

using testing::HasSubstr;
using testing::Not;

class OpenSslTool : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(FORESIGHT_OPENSSL).empty()) GTEST_SKIP() << "the program openssl is not there";
  }
  ProgramResult Verify(const std::filesystem::path& folder, const char* purpose) const {
    return RunProgram(FORESIGHT_OPENSSL, {"verify", "-x509_strict", "-CAfile", keys_.ca_file(),
                                          "-CRLfile", keys_.list_file(), "-crl_check", "-purpose",
                                          purpose, (folder / kCertificateFile).string()});
  }

  struct Keys : LinkKeys {
    std::string ca_file() const {
      return (folder("").parent_path().parent_path() / kCaFile).string();
    }
    std::string list_file() const {
      return (folder("").parent_path().parent_path() / kRevocationsFile).string();
    }
  } keys_;
};

TEST_F(OpenSslTool, VerifiesEachCertificateForItsOwnUseOnly) {
  const auto head = keys_.Head();
  const auto anna = keys_.Operator();
  const auto head_as_server = Verify(head, "sslserver");
  EXPECT_EQ(head_as_server.exit_code, 0) << head_as_server.errors;
  const auto anna_as_client = Verify(anna, "sslclient");
  EXPECT_EQ(anna_as_client.exit_code, 0) << anna_as_client.errors;
  EXPECT_THAT(Verify(head, "sslclient").errors, HasSubstr("unsuitable certificate purpose"));
  EXPECT_THAT(Verify(anna, "sslserver").errors, HasSubstr("unsuitable certificate purpose"));
}

TEST_F(OpenSslTool, SeesWhatTheListRevokes) {
  const auto anna = keys_.Operator();
  const std::string copy = keys_ / kCertificateFile;
  std::filesystem::copy_file(anna / kCertificateFile, copy);
  ASSERT_TRUE(keys_.ca().Revoke("anna", keys_.now_utc_s()));
  const auto result = Verify(keys_ / "", "sslclient");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.errors, HasSubstr("certificate revoked"));
}

TEST_F(OpenSslTool, ReadsNamesAndUses) {
  const auto head = keys_.Head("left", {"10.0.0.2", "head.local"});
  const std::string text =
      RunProgram(FORESIGHT_OPENSSL,
                 {"x509", "-in", (head / kCertificateFile).string(), "-noout", "-text"})
          .output;
  EXPECT_THAT(text, HasSubstr("URI:foresight:head:left"));
  EXPECT_THAT(text, HasSubstr("DNS:left.foresight.internal, IP Address:10.0.0.2, DNS:head.local"));
  EXPECT_THAT(text, HasSubstr("NIST CURVE: P-256"));
  EXPECT_THAT(text, HasSubstr("TLS Web Server Authentication"));
  EXPECT_THAT(text, Not(HasSubstr("TLS Web Client Authentication")));
  EXPECT_THAT(text, HasSubstr("CA:FALSE"));
}

TEST_F(OpenSslTool, FindsTheKeyInOrder) {
  const auto anna = keys_.Operator();
  const auto result = RunProgram(
      FORESIGHT_OPENSSL, {"pkey", "-in", (anna / kPrivateKeyFile).string(), "-check", "-noout"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("Key is valid"));
}

}  // namespace
}  // namespace foresight
