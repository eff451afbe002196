// Who gets past the handshake of a head and of a station, and who does not.
#include <gmock/gmock.h>

#include "hardware/link/wire/grpc_log.h"
#include "hardware/link/wire/peer.h"
#include "tests/hardware/link/wire/link_end.h"

namespace foresight {
namespace {

using testing::HasSubstr;

class Handshake : public testing::Test {
 protected:
  Handshake() { SendGrpcLogToOurs(); }

  /// A client that checks nothing, so that what refuses is the head.
  grpc::Status AskAs(const std::filesystem::path& keys) {
    return TinyStation(head_.Address(), BareChannelCredentials(keys)).Ask();
  }
  void ExpectRefused(const std::filesystem::path& keys, const std::string& in_log) {
    const grpc::Status status = AskAs(keys);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE) << status.error_message();
    EXPECT_EQ(head_.peer(), std::nullopt);
    EXPECT_THAT(log_.Text(), HasSubstr(in_log));
  }

  CapturedLog log_;
  LinkKeys keys_;
  std::filesystem::path head_keys_ = keys_.Head();
  TinyHead head_{head_keys_};
};

TEST_F(Handshake, AnOperatorIsLetInWithRoleAndName) {
  TinyStation station(head_.Address(), keys_.Operator());
  const grpc::Status status = station.Ask();
  ASSERT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(head_.peer(), (LinkIdentity{LinkRole::kOperator, "anna"}));
  EXPECT_EQ(PeerOf(*station.context()).value(), (LinkIdentity{LinkRole::kHead, "left"}));
}

TEST_F(Handshake, AnObserverIsLetInAsOne) {
  ASSERT_TRUE(TinyStation(head_.Address(), keys_.Observer()).Ask().ok());
  EXPECT_EQ(head_.peer(), (LinkIdentity{LinkRole::kObserver, "otto"}));
}

TEST_F(Handshake, ARenewedCertificateIsLetIn) {
  const auto anna = keys_.Operator();
  ASSERT_TRUE(keys_.ca().Renew("anna", {}, keys_.now_utc_s()));
  EXPECT_TRUE(TinyStation(head_.Address(), anna).Ask().ok());
}

TEST_F(Handshake, RefusesWhoHasNoCertificate) {
  grpc::SslCredentialsOptions options;
  options.pem_root_certs = ReadFile(head_keys_ / kCaFile).value();
  const auto status = TinyStation(head_.Address(), grpc::SslCredentials(options)).Ask();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(head_.peer(), std::nullopt);
  EXPECT_THAT(log_.Text(), HasSubstr("peer did not return a certificate"));
}

TEST_F(Handshake, RefusesWhoDoesNotSpeakTls) {
  const auto status = TinyStation(head_.Address(), grpc::InsecureChannelCredentials()).Ask();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(head_.peer(), std::nullopt);
}

TEST_F(Handshake, RefusesACertificateOfAForeignCa) {
  LinkKeys foreign;
  const auto eve = foreign.Operator("eve");
  // With the head's CA in its folder: only eve's own certificate is foreign.
  ASSERT_TRUE(WriteFileAtomically(eve / kCaFile, keys_.Keys().certificate_pem));
  ExpectRefused(eve, "certificate verify failed");
}

TEST_F(Handshake, RefusesAnExpiredCertificate) {
  const auto anna = keys_.Operator();
  const std::int64_t now = keys_.now_utc_s();
  keys_.Rewrite(anna, {LinkRole::kOperator, "anna"}, {now - 10 * kDayS, now - kDayS});
  ExpectRefused(anna, "certificate verify failed");
}

TEST_F(Handshake, RefusesACertificateThatIsNotYetValid) {
  const auto anna = keys_.Operator();
  const std::int64_t now = keys_.now_utc_s();
  keys_.Rewrite(anna, {LinkRole::kOperator, "anna"}, {now + kDayS, now + 10 * kDayS});
  ExpectRefused(anna, "certificate verify failed");
}

TEST_F(Handshake, RefusesAHeadsCertificateAsAClient) {
  ExpectRefused(keys_.Head("right"), "certificate verify failed");
}

TEST_F(Handshake, RefusesARevokedCertificateAndSaysWhose) {
  const auto kept = keys_ / "stolen";
  std::filesystem::copy(keys_.Operator(), kept);
  ASSERT_TRUE(keys_.ca().Revoke("anna", keys_.now_utc_s()));
  ExpectRefused(kept, "refused a peer: foresight:operator:anna: the certificate");
}

TEST_F(Handshake, ANewListIsHeardInConnectionsThatAreOpen) {
  const auto kept = keys_ / "stolen";
  std::filesystem::copy(keys_.Operator(), kept);
  TinyStation station(head_.Address(), kept);
  ASSERT_TRUE(station.Ask().ok());
  ASSERT_TRUE(keys_.ca().Revoke("anna", keys_.now_utc_s()));
  const grpc::Status status = station.Ask();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_THAT(status.error_message(), HasSubstr("was revoked"));
  EXPECT_EQ(AskAs(kept).error_code(), grpc::StatusCode::UNAVAILABLE);
}

TEST_F(Handshake, OneRefusalDoesNotTouchTheOthers) {
  TinyStation station(head_.Address(), keys_.Operator());
  ASSERT_TRUE(station.Ask().ok());
  EXPECT_FALSE(AskAs(keys_.Head("right")).ok());
  EXPECT_TRUE(station.Ask().ok());
}

/// The other direction: a station before something that pretends to be its head.
class StationsHandshake : public testing::Test {
 protected:
  grpc::Status AskAt(const std::filesystem::path& server_keys,
                     const std::string& host = "127.0.0.1", const std::string& expected_host = "") {
    const TinyHead server(BareServerCredentials(server_keys));
    return TinyStation(server.Address(host), anna_, expected_host).Ask();
  }
  void ExpectRefused(const grpc::Status& status, const std::string& in_log = "") {
    EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE) << status.error_message();
    EXPECT_THAT(log_.Text(), HasSubstr(in_log));
  }

  CapturedLog log_;
  LinkKeys keys_;
  std::filesystem::path anna_ = keys_.Operator();
};

TEST_F(StationsHandshake, TakesTheHeadAtEachOfItsAddresses) {
  const auto head = keys_.Head("left", {"127.0.0.1", "localhost"});
  EXPECT_TRUE(AskAt(head).ok());
  EXPECT_TRUE(AskAt(head, "localhost").ok());
}

TEST_F(StationsHandshake, TakesTheHeadAtAnotherAddressByItsStableName) {
  const auto head = keys_.Head("left", {"10.0.0.2"});
  EXPECT_FALSE(AskAt(head).ok());
  EXPECT_TRUE(AskAt(head, "127.0.0.1", StableHostOfHead("left")).ok());
  EXPECT_FALSE(AskAt(head, "127.0.0.1", StableHostOfHead("right")).ok());
}

TEST_F(StationsHandshake, RefusesAnotherHost) {
  ExpectRefused(AskAt(keys_.Head("left", {"10.0.0.2", "other"})),
                "its certificate is not one for 127.0.0.1");
}

TEST_F(StationsHandshake, RefusesAnOperatorAsAHead) {
  const auto eve = keys_.Operator("eve");
  ExpectRefused(AskAt(eve));
  // Even one that claims the head's addresses.
  const std::int64_t now = keys_.now_utc_s();
  keys_.Rewrite(eve, {LinkRole::kOperator, "eve"}, {now - kDayS, now + kDayS}, {"127.0.0.1"});
  ExpectRefused(AskAt(eve));
}

TEST_F(StationsHandshake, RefusesAHeadOfAForeignCa) {
  LinkKeys foreign;
  const auto fake = foreign.Head();
  ASSERT_TRUE(WriteFileAtomically(fake / kCaFile, keys_.Keys().certificate_pem));
  ExpectRefused(AskAt(fake));
}

TEST_F(StationsHandshake, RefusesAnExpiredHead) {
  const auto head = keys_.Head();
  const std::int64_t now = keys_.now_utc_s();
  keys_.Rewrite(head, {LinkRole::kHead, "left"}, {now - 10 * kDayS, now - kDayS}, {"127.0.0.1"});
  ExpectRefused(AskAt(head));
}

TEST_F(StationsHandshake, RefusesARevokedHead) {
  const auto kept = keys_ / "stolen";
  std::filesystem::copy(keys_.Head(), kept);
  ASSERT_TRUE(keys_.ca().Revoke("left", keys_.now_utc_s()));
  ExpectRefused(AskAt(kept), "foresight:head:left: the certificate");
}

TEST(PlaintextLink, NeedsALoopbackAddress) {
  for (const char* host : {"127.0.0.1", "127.1.2.3", "localhost", "::1"}) {
    EXPECT_TRUE(PlaintextHeadCredentials(host)) << host;
    EXPECT_TRUE(PlaintextStationCredentials(host)) << host;
  }
  for (const char* host : {"0.0.0.0", "10.0.0.2", "::", "head.local", "", "127.0.0.1.evil.org",
                           "localhost.evil.org", "127.1"}) {
    const auto credentials = PlaintextHeadCredentials(host);
    ASSERT_FALSE(credentials) << host;
    EXPECT_EQ(credentials.error().code, ErrorCode::kInvalidOptions);
    EXPECT_THAT(credentials.error().message, HasSubstr("on this machine only"));
    EXPECT_FALSE(PlaintextStationCredentials(host)) << host;
  }
}

TEST(PlaintextLink, ItsPeerIsTheOperatorLocal) {
  const TinyHead head(PlaintextHeadCredentials("127.0.0.1").value());
  TinyStation station(head.Address(), PlaintextStationCredentials("127.0.0.1").value());
  const grpc::Status status = station.Ask();
  ASSERT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(head.peer(), (LinkIdentity{LinkRole::kOperator, "local"}));
}

}  // namespace
}  // namespace foresight
