// Scans by UDP on loopback, between a head and a station that speak gRPC beside it.
#include <gmock/gmock.h>

#include "core/base/random.h"
#include "hardware/head/scan_assembler.h"
#include "hardware/link/chunks/scan_digest.h"
#include "tests/hardware/link/chunks/random_scans.h"
#include "tests/hardware/link/head_bench.h"

namespace foresight {
namespace {

using ::testing::HasSubstr;

class Archive final : public ScanArchive {
 public:
  Status Keep(const Scan& whole) override {
    const std::lock_guard lock(mutex_);
    scans_.push_back(whole);
    return {};
  }
  std::vector<Scan> Scans() const {
    const std::lock_guard lock(mutex_);
    return scans_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Scan> scans_;
};

class BurstSessionTest : public ::testing::Test {
 protected:
  /// A scan that the head has, with more than a stream of a thin path carries.
  std::string ScanAtHead(const std::string& id = "a-scan") {
    Scan scan = samples::RandomScan(3, 300, 4);
    scan.uuid = id;
    scan.state = ScanState::kComplete;
    scan.reason.clear();
    EXPECT_TRUE(head->Home());
    EXPECT_TRUE(head->StartScan(ScanPlan(), bench.shelf().Begin(id, {}).value()));
    head->Play(scan);
    EXPECT_TRUE(
        Eventually([&] { return bench.shelf().Find(id).value().state != ScanState::kRunning; }));
    return id;
  }
  Scan OnHead(const std::string& id) { return *bench.shelf().Snapshot(id).value(); }
  std::shared_ptr<RemoteHead> Connect(int port = 0) {
    RemoteHead::Options options;
    options.address = "127.0.0.1:" + std::to_string(bench.port());
    options.spool = bench.folder / "spool";
    options.archive = archive;
    options.burst.emplace();
    options.burst->port = port;
    return RemoteHead::Connect({bench.Channel()}, options, std::chrono::milliseconds(3000)).value();
  }
  /// Asks the head as a station of its own; the first message of a stream that sends nothing.
  link::BurstReply OpenBurst(const BurstReceiver& receiver) {
    link::BurstRequest request;
    request.set_port(receiver.address().port);
    link::BurstReply reply;
    const auto context = LinkSession::Context(std::chrono::milliseconds(3000));
    EXPECT_TRUE(stub->OpenBurst(context.get(), request, &reply).ok());
    return reply;
  }
  grpc::Status Refusal(const link::BurstRequest& request) {
    link::BurstReply reply;
    const auto context = LinkSession::Context(std::chrono::milliseconds(3000));
    return stub->OpenBurst(context.get(), request, &reply);
  }

  const std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>();
  HeadBench bench{head};
  const std::shared_ptr<Archive> archive = std::make_shared<Archive>();
  const std::unique_ptr<link::SensorHead::Stub> stub = link::SensorHead::NewStub(bench.Channel()());
};

TEST_F(BurstSessionTest, AScanComesByBurstsAndIsTheHeads) {
  const std::string id = ScanAtHead();
  const auto remote = Connect();
  remote->Fetch(id);
  ASSERT_TRUE(Eventually([&] { return archive->Scans().size() == 1; }));
  EXPECT_EQ(ScanDigest(archive->Scans()[0]), ScanDigest(OnHead(id)));
  EXPECT_TRUE(Eventually([&] { return bench.shelf().Find(id).value().confirmed; }));
  const BurstHealth burst = remote->Health().burst;
  EXPECT_TRUE(burst.wanted);
  // Lossless images of noise alone are more than a third of it; a stream beside bursts has none.
  EXPECT_GT(burst.bytes, 100'000);
  EXPECT_EQ(burst.refused, 0);
  EXPECT_EQ(burst.trouble, "");
}

TEST_F(BurstSessionTest, AStreamThatSendsNothingIsEnough) {
  const std::string id = ScanAtHead();
  const auto receiver = BurstReceiver::Listen({"127.0.0.1", 0}).value();
  const link::BurstReply reply = OpenBurst(*receiver);
  const BurstKey key = BurstKey::FromBytes(reply.key_id(), reply.key()).value();
  ASSERT_TRUE(receiver->Expect(key, id, {}));
  const auto context = LinkSession::Context(std::chrono::milliseconds(0));
  const auto stream = stub->Transfer(context.get());
  link::TransferRequest request;
  request.mutable_start()->set_scan_id(id);
  request.mutable_start()->set_burst_key_id(reply.key_id());
  ChunkSet none;
  request.mutable_start()->set_have(none.Encode());
  ASSERT_TRUE(stream->Write(request));
  // No credit: one chunk, which is never acknowledged.
  ScanBuilder builder(id);
  ASSERT_TRUE(Eventually([&] {
    for (const Chunk& chunk : receiver->TakeChunks()) EXPECT_TRUE(builder.Take(chunk));
    receiver->SetHave(builder.Have());
    return builder.Progress().complete;
  }));
  EXPECT_EQ(ScanDigest(builder.Whole().value()), ScanDigest(OnHead(id)));
  // The word of what is here ends the carousel.
  request.Clear();
  request.mutable_acknowledge()->set_have(builder.Have().Encode());
  ASSERT_TRUE(stream->Write(request));
  std::int64_t before = -1;
  EXPECT_TRUE(Eventually([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return std::exchange(before, receiver->Counts().datagrams) == receiver->Counts().datagrams;
  }));
  context->TryCancel();
  link::Chunk chunk;
  while (stream->Read(&chunk)) {
  }
  stream->Finish();
}

TEST_F(BurstSessionTest, ForeignDatagramsAreCountedAndChangeNothing) {
  const std::string id = ScanAtHead();
  const auto free_port = BurstReceiver::Listen({"127.0.0.1", 0}).value()->address().port;
  const auto remote = Connect(free_port);
  const auto stranger = DatagramSocket::Bind({"127.0.0.1", 0}).value();
  std::vector<std::vector<std::uint8_t>> datagrams(10, std::vector<std::uint8_t>(500, 'F'));
  ASSERT_TRUE(stranger.Send(datagrams, datagrams.size(), {0x7F000001, free_port}));
  remote->Fetch(id);
  ASSERT_TRUE(Eventually([&] { return archive->Scans().size() == 1; }));
  EXPECT_EQ(ScanDigest(archive->Scans()[0]), ScanDigest(OnHead(id)));
  EXPECT_TRUE(Eventually([&] { return remote->Health().burst.refused == 10; }));
}

TEST_F(BurstSessionTest, AHeadWithoutBurstsSendsTheScanOnTheStream) {
  const std::string id = ScanAtHead();
  bench.peer.may_operate = false;  // observers get none either
  const auto remote = Connect();
  remote->Fetch(id);
  ASSERT_TRUE(Eventually([&] { return archive->Scans().size() == 1; }));
  EXPECT_EQ(ScanDigest(archive->Scans()[0]), ScanDigest(OnHead(id)));
  EXPECT_EQ(remote->Health().burst.bytes, 0);
  EXPECT_THAT(remote->Health().burst.trouble, HasSubstr("anna is an observer"));
}

TEST_F(BurstSessionTest, RequestsThatSayNonsenseAreRefused) {
  link::BurstRequest request;
  EXPECT_THAT(Refusal(request).error_message(), HasSubstr("port 0"));
  request.set_port(70'000);
  EXPECT_FALSE(Refusal(request).ok());
  request.set_port(47'131);
  request.set_datagram_bytes(9000);
  EXPECT_THAT(Refusal(request).error_message(), HasSubstr("datagram_bytes = 9000"));
  request.set_datagram_bytes(-1);
  EXPECT_FALSE(Refusal(request).ok());
  request.set_datagram_bytes(0);
  for (const char* host : {"255.255.255.255", "224.0.0.1", "0.0.0.0", "station", "::1"}) {
    request.set_host(host);
    EXPECT_THAT(Refusal(request).error_message(), HasSubstr(host));
  }
}

TEST_F(BurstSessionTest, AnotherOperatorWaitsUntilThePathIsFree) {
  const auto receiver = BurstReceiver::Listen({"127.0.0.1", 0}).value();
  const link::BurstReply first = OpenBurst(*receiver);
  bench.peer.name = "bert";
  link::BurstRequest request;
  request.set_port(receiver->address().port);
  EXPECT_THAT(Refusal(request).error_message(), HasSubstr("anna has the burst path"));
  EXPECT_FALSE(bench.desk().bursts().Find(first.key_id(), "bert")) << "with anna's key neither";
  bench.peer.name = "anna";
  const link::BurstReply second = OpenBurst(*receiver);
  EXPECT_NE(second.key(), first.key()) << "each path has a key of its own";
  EXPECT_FALSE(bench.desk().bursts().Find(first.key_id(), "anna"));
  EXPECT_TRUE(bench.desk().bursts().Find(second.key_id(), "anna"));
}

TEST_F(BurstSessionTest, EndsWhenItsStreamIsGoneForAWhile) {
  const std::string id = ScanAtHead();
  BurstSenderOptions options;
  const auto receiver = BurstReceiver::Listen({"127.0.0.1", 0}).value();
  options.to = {0x7F000001, receiver->address().port};
  const auto session = BurstSession::Open(bench.shelf(), "anna", options, 0.3).value();
  session->Begin(ScanToSend{OnHead(id), ""}, {});
  EXPECT_TRUE(Eventually([&] { return session->SentBytes() > 0; }));
  EXPECT_FALSE(session->Over());
  session->StreamGone();
  EXPECT_FALSE(session->Over()) << "the stream may come back";
  EXPECT_TRUE(Eventually([&] { return session->Over(); }));
  std::int64_t before = -1;
  EXPECT_TRUE(Eventually([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return std::exchange(before, session->SentBytes()) == session->SentBytes();
  })) << "nothing is sent any more";
}

}  // namespace
}  // namespace foresight
