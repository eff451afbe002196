#include "hardware/link/client/burst_client.h"

#include "core/base/log.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kBurstTimeout{15'000};  ///< as for the rig on a thin path
/// Twice the longest known blackout: then something else is wrong with the path.
constexpr double kLongSilence_s = 60.0;

/// The link is there, and the answer is no.
bool IsRefusal(const grpc::Status& called) {
  return called.error_code() != grpc::StatusCode::UNAVAILABLE &&
         called.error_code() != grpc::StatusCode::DEADLINE_EXCEEDED &&
         called.error_code() != grpc::StatusCode::CANCELLED;
}

}  // namespace

Result<std::unique_ptr<BurstClient>> BurstClient::Listen(const Options& options) {
  const TcpAddress address{options.host.empty() ? "0.0.0.0" : options.host,
                           static_cast<std::uint16_t>(options.port)};
  FORESIGHT_TRY(auto receiver, BurstReceiver::Listen(address));
  return std::unique_ptr<BurstClient>(new BurstClient(options, std::move(receiver)));
}

BurstClient::~BurstClient() {
  const BurstCounts counts = Counts();
  LogInfo(
      "burst path: {} datagrams, {} bytes, {} chunks; refused: {} foreign, {} replayed, {} forged",
      counts.datagrams, counts.bytes, counts.chunks, counts.foreign, counts.replayed,
      counts.forged);
}

Result<std::uint32_t> BurstClient::Open(LinkSession& session, const std::string& scan_id,
                                        const ChunkSet& have, const std::stop_token& stop) {
  open_ = untold_ = false;
  link::BurstRequest request;
  request.set_host(options_.host);
  request.set_port(receiver_->address().port);
  request.set_datagram_bytes(options_.datagram_bytes);
  link::BurstReply reply;
  const auto stub = session.WaitForStub(stop);
  if (stub == nullptr) return 0;
  const auto context = LinkSession::Context(kBurstTimeout);
  const std::stop_callback cancel(stop, [&] { context->TryCancel(); });
  const grpc::Status called = stub->OpenBurst(context.get(), request, &reply);
  if (!called.ok()) {
    const Error error = session.ToError(called, "its burst path");
    if (!IsRefusal(called)) return tl::unexpected(error);
    SetTrouble(error.message);
    return 0;
  }
  FORESIGHT_TRY(const BurstKey key, BurstKey::FromBytes(reply.key_id(), reply.key()));
  FORESIGHT_CHECK(receiver_->Expect(key, scan_id, have));
  open_ = true;
  SetTrouble("");
  return key.id;
}

void BurstClient::SetTrouble(const std::string& trouble) {
  const std::lock_guard lock(mutex_);
  if (!trouble.empty() && trouble != trouble_) LogWarning("{}: scans come without bursts", trouble);
  trouble_ = trouble;
}

bool BurstClient::Carries() const {
  return open_ && receiver_->SilenceSeconds() < kLongSilence_s;
}

void BurstClient::SetHave(const ChunkSet& have) {
  receiver_->SetHave(have);
  untold_ = true;
}

std::string BurstClient::Tell(const ChunkSet& have, double now_s) {
  std::string told = have.Encode();
  pace_.Sent(static_cast<double>(told.size()), now_s);
  untold_ = false;
  return told;
}

std::string BurstClient::Trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

}  // namespace foresight
