#include "hardware/link/client/scan_fetcher.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <future>

#include "hardware/link/chunks/chunk_order.h"
#include "hardware/link/protocol/chunk_messages.h"
#include "hardware/link/wire/channel_arguments.h"
#include "tests/hardware/link/chunks/random_scans.h"
#include "tests/hardware/link/head_bench.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

/// A head that sends nothing, and keeps what the first transfer asked for.
class SilentHead final : public link::SensorHead::Service {
 public:
  explicit SilentHead(int port = 0) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:" + std::to_string(port), grpc::InsecureServerCredentials(),
                             &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~SilentHead() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status Transfer(
      grpc::ServerContext* /*context*/,
      grpc::ServerReaderWriter<link::Chunk, link::TransferRequest>* stream) override {
    link::TransferRequest request;
    if (stream->Read(&request) && !asked_.exchange(true)) start_.set_value(request.start());
    while (stream->Read(&request)) {
    }
    return grpc::Status::OK;
  }

  std::shared_ptr<grpc::Channel> Channel() const {
    grpc::ChannelArguments arguments;
    SetStationArguments(arguments, LinkPath::kBursts, 100);
    return grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(port_),
                                     grpc::InsecureChannelCredentials(), arguments);
  }
  link::TransferStart Start() {
    auto start = start_.get_future();
    if (start.wait_for(std::chrono::seconds(10)) != std::future_status::ready) return {};
    return start.get();
  }

 private:
  int port_ = 0;
  std::atomic<bool> asked_{false};
  std::promise<link::TransferStart> start_;
  std::unique_ptr<grpc::Server> server_;
};

/// A head that sends all of a scan, and says then that it has to go.
class PassingHead final : public link::SensorHead::Service {
 public:
  explicit PassingHead(const Scan& scan) : scan_{scan, ""} {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~PassingHead() override { Stop(); }

  grpc::Status Transfer(
      grpc::ServerContext* /*context*/,
      grpc::ServerReaderWriter<link::Chunk, link::TransferRequest>* stream) override {
    link::TransferRequest request;
    stream->Read(&request);
    ChunkSource source(scan_, {}, EncodeParts);
    while (auto chunk = source.Next().value()) stream->Write(ToMessage(*std::move(chunk)));
    sent = true;
    return {grpc::StatusCode::UNAVAILABLE, "the head goes"};
  }

  int port() const { return port_; }
  void Stop() { server_->Shutdown(std::chrono::system_clock::now()); }

  std::atomic<bool> sent{false};

 private:
  const ScanToSend scan_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

/// Takes its time where a test wants it to.
class GatedSink final : public ScanSink {
 public:
  void OnScanStarted(const Scan& /*header*/) override { Pass(start); }
  void OnLine(const LidarLine& /*line*/) override { Pass(line); }
  void OnMotorSamples(std::span<const MotorSample> /*samples*/) override {}
  void OnFrame(const CameraFrame& /*frame*/) override {}
  void OnScanEnded(ScanState /*state*/, const std::string& /*reason*/) override {}

  struct Gate {
    std::atomic<bool> reached{false};
    std::atomic<bool> open{false};
  };
  Gate start;
  Gate line;

 private:
  static void Pass(Gate& gate) {
    gate.reached = true;
    while (!gate.open) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
};

struct ScanFetcherTest : ::testing::Test {
  /// What a station asks for whose messages come and go in `round_trip_s`.
  link::TransferStart Asked(bool thin, double round_trip_s) {
    LinkSession session({[this] { return head.Channel(); }}, "head");
    ScanFetcher::Options options;
    options.spool = folder / "spool";
    options.thin = thin;
    options.round_trip = [=] { return round_trip_s; };
    ScanFetcher fetcher(session, std::move(options));
    link::ScanOnHead scan;
    scan.set_scan_id("0c2f1a3e-0000-4000-8000-000000000001");
    scan.set_state("running");
    fetcher.Heard({scan}, true);
    fetcher.Fetch(scan.scan_id());
    return head.Start();
  }

  const TemporaryFolder folder;
  SilentHead head;
};

TEST_F(ScanFetcherTest, APathWithShortRoundTripsIsTakenForWide) {
  const link::TransferStart start = Asked(false, 0.05);
  EXPECT_EQ(start.scan_id(), "0c2f1a3e-0000-4000-8000-000000000001");
  EXPECT_EQ(start.preferences().bytes_per_s(), 0);
  EXPECT_EQ(start.credit_bytes(), TransferRate::kWideCredit);
}

/// A short message passes a thin path's queue at once where nothing waits in it.
TEST_F(ScanFetcherTest, APathThatIsSaidToBeThinIsThinFromTheFirstMoment) {
  const link::TransferStart start = Asked(true, 0.05);
  EXPECT_EQ(start.scan_id(), "0c2f1a3e-0000-4000-8000-000000000001");
  EXPECT_GT(start.preferences().bytes_per_s(), 0);
  EXPECT_LT(static_cast<double>(start.preferences().bytes_per_s()), kThinBytesPerS);
  EXPECT_EQ(start.credit_bytes(), TransferRate::kLeastCredit);
}

/// An image takes 50 ms to read, the first twentieth of a window of a second.
TEST_F(ScanFetcherTest, AConnectionIsUsedWhileWhatCameBeforeIsStillTakenIn) {
  Scan scan = samples::RandomScan(3, 40, 1);
  scan.uuid = "0c2f1a3e-0000-4000-8000-000000000002";
  auto first = std::make_unique<PassingHead>(scan);
  const int port = first->port();
  const auto sink = std::make_shared<GatedSink>();
  LinkSession session({[port] {
                        grpc::ChannelArguments arguments;
                        SetStationArguments(arguments, LinkPath::kBursts, 100);
                        return grpc::CreateCustomChannel("127.0.0.1:" + std::to_string(port),
                                                         grpc::InsecureChannelCredentials(),
                                                         arguments);
                      }},
                      "head");
  ScanFetcher::Options options;
  options.spool = folder / "spool";
  ScanFetcher fetcher(session, std::move(options));
  fetcher.Expect(scan, sink);
  fetcher.Started(scan.uuid);
  ASSERT_TRUE(Eventually([&] { return sink->start.reached && first->sent; }));
  first->Stop();
  ASSERT_TRUE(Eventually([&] { return !session.Connected(); })) << "all that was sent has come";
  sink->start.open = true;
  ASSERT_TRUE(Eventually([&] { return sink->line.reached.load(); }));
  first.reset();
  SilentHead second_head(port);
  EXPECT_EQ(second_head.Start().scan_id(), scan.uuid);
  sink->line.open = true;
}

}  // namespace
}  // namespace foresight
