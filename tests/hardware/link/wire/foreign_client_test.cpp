// Programs that are not ours before a head: openssl s_client, and gRPC for Python.
#include <gmock/gmock.h>

#include "hardware/link/wire/grpc_log.h"
#include "tests/hardware/link/wire/link_end.h"
#include "tests/support/run_program.h"

namespace foresight {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kPython = "/usr/bin/python3";

class ForeignClient : public testing::Test {
 protected:
  ForeignClient() { SendGrpcLogToOurs(); }

  /// Ends after the handshake and what the head says upon it.
  ProgramResult Connect(const std::vector<std::string>& more, const char* says = "") const {
    std::vector<std::string> arguments = {"s_client",
                                          "-connect",
                                          head_.Address(),
                                          "-CAfile",
                                          (head_keys_ / kCaFile).string(),
                                          "-alpn",
                                          "h2",
                                          "-verify_return_error",
                                          "-verify_ip",
                                          "127.0.0.1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram("/bin/sh",
                      {"-c", std::string("echo '") + says + "' | \"$0\" \"$@\"", FORESIGHT_OPENSSL},
                      arguments);
  }
  static ProgramResult RunProgram(const std::string& program, std::vector<std::string> arguments,
                                  const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    RunLimits limits;
    limits.seconds = 30;
    return foresight::RunProgram(program, arguments, limits);
  }
  static std::vector<std::string> With(const std::filesystem::path& keys) {
    return {"-cert", (keys / kCertificateFile).string(), "-key", (keys / kPrivateKeyFile).string()};
  }

  CapturedLog log_;
  LinkKeys keys_;
  std::filesystem::path head_keys_ = keys_.Head();
  std::filesystem::path anna_ = keys_.Operator();
  TinyHead head_{head_keys_};
};

class OpenSslClient : public ForeignClient {
 protected:
  void SetUp() override {
    if (std::string(FORESIGHT_OPENSSL).empty()) GTEST_SKIP() << "the program openssl is not there";
  }
};

TEST_F(OpenSslClient, VerifiesTheHeadAndSpeaksTls13) {
  const ProgramResult result = Connect(With(anna_));
  EXPECT_THAT(result.output, AllOf(HasSubstr("TLSv1.3"), HasSubstr("Verify return code: 0 (ok)")))
      << result.errors;
  EXPECT_THAT(result.output, HasSubstr("ALPN protocol: h2"));
}

TEST_F(OpenSslClient, IsRefusedWithTls12) {
  std::vector<std::string> arguments = With(anna_);
  arguments.push_back("-tls1_2");
  const ProgramResult result = Connect(arguments);
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("Cipher is (NONE)"));
  EXPECT_THAT(log_.Text(), HasSubstr("no shared cipher"));
}

TEST_F(OpenSslClient, IsCutOffWithoutACertificate) {
  // A client of TLS 1.3 hears of it after its own end of the handshake, so it has to listen.
  const ProgramResult result = Connect({"-ign_eof"});
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.errors, HasSubstr("unexpected eof"));
  EXPECT_THAT(log_.Text(), HasSubstr("peer did not return a certificate"));
}

TEST_F(OpenSslClient, IsJudgedAnewWhereItResumesASession) {
  const std::string session = keys_ / "session.pem";
  const auto connect_with = [&](const char* option) {
    std::vector<std::string> arguments = With(keys_ / "stolen");
    arguments.insert(arguments.end(), {"-ign_eof", option, session});
    return Connect(arguments, "no HTTP");  // on which the head ends the connection
  };
  std::filesystem::copy(anna_, keys_ / "stolen");
  connect_with("-sess_out");
  ASSERT_TRUE(std::filesystem::exists(session));
  ASSERT_THAT(log_.Text(), Not(HasSubstr("refused a peer")));
  ASSERT_TRUE(keys_.ca().Revoke("anna", keys_.now_utc_s()));
  const ProgramResult result = connect_with("-sess_in");
  EXPECT_THAT(log_.Text(), HasSubstr("refused a peer: foresight:operator:anna")) << result.output;
}

TEST_F(OpenSslClient, IsRefusedWhereItsCertificateSaysNoRole) {
  // Made of our CA's key by other means than ours; TLS itself is content with it.
  const auto ca = keys_.ca().folder();
  const auto made = foresight::RunProgram(
      FORESIGHT_OPENSSL, {"req", "-x509", "-new", "-key", (anna_ / kPrivateKeyFile).string(), "-CA",
                          (ca / "ca.crt").string(), "-CAkey", (ca / "ca.key").string(), "-subj",
                          "/OU=operator/CN=anna", "-addext", "extendedKeyUsage=clientAuth",
                          "-addext", "basicConstraints=critical,CA:FALSE", "-days", "1", "-out",
                          (anna_ / kCertificateFile).string()});
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  TinyStation station(head_.Address(), BareChannelCredentials(anna_));
  EXPECT_EQ(station.Ask().error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_THAT(log_.Text(), HasSubstr("does not say who on the link it is of"));
}

class PythonClient : public ForeignClient {
 protected:
  void SetUp() override {
    if (foresight::RunProgram(kPython, {"-c", "import grpc"}).exit_code != 0)
      GTEST_SKIP() << "python3-grpcio is not there";
  }

  /// The code of a call that the head does not carry out: UNIMPLEMENTED behind the handshake.
  std::string Call(const std::filesystem::path& keys, bool with_certificate) const {
    constexpr const char* kScript = R"(
import sys, grpc
address, ca, key, crt = sys.argv[1:5]
read = lambda path: open(path, 'rb').read()
own = dict(private_key=read(key), certificate_chain=read(crt)) if len(sys.argv) > 5 else {}
channel = grpc.secure_channel(address, grpc.ssl_channel_credentials(read(ca), **own))
call = channel.unary_unary('/foresight.link.SensorHead/' + 'GetRig')
try:
    call(b'', timeout=20)
    print('OK')
except grpc.RpcError as error:
    print(error.code().name)
)";
    std::vector<std::string> arguments = {"-c",
                                          kScript,
                                          head_.Address(),
                                          (head_keys_ / kCaFile).string(),
                                          (keys / kPrivateKeyFile).string(),
                                          (keys / kCertificateFile).string()};
    if (with_certificate) arguments.emplace_back("with");
    return RunProgram(kPython, arguments, {}).output;
  }
};

TEST_F(PythonClient, GetsPastTheHandshakeWithAnOperatorsKeys) {
  EXPECT_EQ(Call(anna_, true), "UNIMPLEMENTED\n");
}

TEST_F(PythonClient, GetsNowhereWithoutACertificate) {
  EXPECT_EQ(Call(anna_, false), "UNAVAILABLE\n");
}

TEST_F(PythonClient, GetsNowhereWithTheKeysOfAnotherCaOrOfAHead) {
  LinkKeys foreign;
  EXPECT_EQ(Call(foreign.Operator(), true), "UNAVAILABLE\n");
  EXPECT_EQ(Call(keys_.Head("right"), true), "UNAVAILABLE\n");
}

TEST_F(PythonClient, GetsNowhereWithRevokedKeys) {
  const auto kept = keys_ / "stolen";
  std::filesystem::copy(anna_, kept);
  ASSERT_TRUE(keys_.ca().Revoke("anna", keys_.now_utc_s()));
  EXPECT_EQ(Call(kept, true), "UNAVAILABLE\n");
}

}  // namespace
}  // namespace foresight
