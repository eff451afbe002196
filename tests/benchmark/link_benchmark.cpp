// The link on loopback: mutual TLS as head and station use it, and the same without encryption.
// Bars: a stream of 64 kB messages over 200 MB/s, a unary round trip under 1 ms (median) with
// mutual TLS.
#include <benchmark/benchmark.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "core/base/quantile.h"
#include "hardware/link/wire/channel_arguments.h"
#include "hardware/link/wire/credentials.h"
#include "hardware/link/wire/peer.h"
#include "sensor_head.grpc.pb.h"
#include "tests/support/link_keys.h"

namespace foresight {
namespace {

using SteadyClock = std::chrono::steady_clock;

enum class Transport { kMutualTls, kPlaintext };

/// Sends as many bytes as the station gives credit for, in chunks of as many as it prefers;
/// identifies itself.
class SendingHead : public link::SensorHead::Service {
 public:
  explicit SendingHead(CertificateGate* gate) : gate_(gate) {}

  grpc::Status Identify(grpc::ServerContext* context, const link::IdentifyRequest*,
                        link::IdentifyReply* reply) override {
    const auto peer = CheckPeer(*context->auth_context(), gate_);
    if (!peer) return {grpc::StatusCode::UNAUTHENTICATED, peer.error().message};
    reply->set_your_name(peer->name);
    return grpc::Status::OK;
  }

  grpc::Status Transfer(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<link::Chunk, link::TransferRequest>* stream) override {
    link::TransferRequest request;
    link::Chunk chunk;
    while (stream->Read(&request)) {
      chunk.set_bytes(
          std::string(static_cast<std::size_t>(request.start().preferences().bytes_per_s()), 'x'));
      const auto size = static_cast<std::int64_t>(chunk.bytes().size());
      for (std::int64_t left = request.start().credit_bytes(); left > 0; left -= size)
        if (!stream->Write(chunk)) return grpc::Status::OK;
    }
    return grpc::Status::OK;
  }

 private:
  CertificateGate* gate_;
};

/// A head and a station in one process, connected over loopback.
class Pair {
 public:
  explicit Pair(Transport transport) {
    std::shared_ptr<grpc::ServerCredentials> of_head;
    std::shared_ptr<grpc::ChannelCredentials> of_station;
    if (transport == Transport::kMutualTls) {
      const TlsFiles head = LoadTlsFiles(keys_.Head()).value();
      const TlsFiles station = LoadTlsFiles(keys_.Operator()).value();
      gate_ = CertificateGate::Open(head).value();
      of_head = HeadCredentials(head, gate_);
      of_station = StationCredentials(station, CertificateGate::Open(station).value());
    } else {
      of_head = PlaintextHeadCredentials("127.0.0.1").value();
      of_station = PlaintextStationCredentials("127.0.0.1").value();
    }
    service_ = std::make_unique<SendingHead>(gate_.get());
    grpc::ServerBuilder builder;
    SetHeadArguments(builder);
    int port = 0;
    builder.AddListeningPort("127.0.0.1:0", of_head, &port);
    builder.RegisterService(service_.get());
    server_ = builder.BuildAndStart();
    grpc::ChannelArguments arguments;
    SetStationArguments(arguments, LinkPath::kThin, 20'000);
    stub_ = link::SensorHead::NewStub(
        grpc::CreateCustomChannel(fmt::format("127.0.0.1:{}", port), of_station, arguments));
  }
  ~Pair() { server_->Shutdown(std::chrono::system_clock::now()); }

  link::SensorHead::Stub& stub() { return *stub_; }

 private:
  LinkKeys keys_;
  std::shared_ptr<CertificateGate> gate_;
  std::unique_ptr<SendingHead> service_;
  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<link::SensorHead::Stub> stub_;
};

/// One stream; an iteration is a burst of 64 MB.
void Stream(benchmark::State& state, Transport transport, std::int64_t chunk_bytes) {
  constexpr std::int64_t kBurst = 64 << 20;
  Pair pair(transport);
  grpc::ClientContext context;
  const auto stream = pair.stub().Transfer(&context);
  link::TransferRequest request;
  request.mutable_start()->set_credit_bytes(kBurst);
  request.mutable_start()->mutable_preferences()->set_bytes_per_s(chunk_bytes);
  link::Chunk chunk;
  for (auto _ : state) {
    if (!stream->Write(request)) return state.SkipWithError("the stream broke");
    for (std::int64_t left = kBurst; left > 0; left -= chunk_bytes)
      if (!stream->Read(&chunk)) return state.SkipWithError("the stream broke");
  }
  state.SetBytesProcessed(state.iterations() * kBurst);
  context.TryCancel();
}

/// An iteration is one call; the median over all of them is what the bar is about.
void RoundTrip(benchmark::State& state, Transport transport) {
  Pair pair(transport);
  std::vector<double> times_ms;
  link::IdentifyReply reply;
  for (auto _ : state) {
    const auto begin = SteadyClock::now();
    grpc::ClientContext context;
    const grpc::Status status = pair.stub().Identify(&context, {}, &reply);
    if (!status.ok()) return state.SkipWithError(status.error_message().c_str());
    times_ms.push_back(
        std::chrono::duration<double, std::milli>(SteadyClock::now() - begin).count());
  }
  if (times_ms.empty()) return;
  state.counters["median_ms"] = Quantile(times_ms, 0.5);
  state.counters["p99_ms"] = Quantile(times_ms, 0.99);
}

/// What the gate costs at a handshake and at each call.
void Gate(benchmark::State& state, bool handshake) {
  LinkKeys keys;
  const auto gate = CertificateGate::Open(LoadTlsFiles(keys.Head()).value()).value();
  const std::string pem = ReadFile(keys.Operator() / kCertificateFile).value();
  for (auto _ : state)
    benchmark::DoNotOptimize(handshake ? gate->Admit(pem) : gate->CheckStillGood(pem));
}
BENCHMARK_CAPTURE(Gate, AtHandshake, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Gate, AtEachCall, false)->Unit(benchmark::kMicrosecond);

constexpr std::int64_t kChunk = 64'000;
BENCHMARK_CAPTURE(Stream, MutualTls64kB, Transport::kMutualTls, kChunk)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Stream, MutualTls4kB, Transport::kMutualTls, 4'000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Stream, Plaintext64kB, Transport::kPlaintext, kChunk)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RoundTrip, MutualTls, Transport::kMutualTls)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(RoundTrip, Plaintext, Transport::kPlaintext)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace foresight
