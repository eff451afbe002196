#include "hardware/link/server/head_service.h"

#include "core/base/contract.h"
#include "core/base/log.h"
#include "hardware/link/protocol/messages.h"
#include "hardware/link/protocol/stand_messages.h"
#include "hardware/link/protocol/stop_messages.h"
#include "hardware/link/server/image_desk.h"
#include "hardware/link/server/look_stream.h"
#include "hardware/link/server/transfer_stream.h"
#include "hardware/link/server/watch_stream.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kServiceTick{100};

/// One of a limited number of streams; empty where there is none left.
class Place {
 public:
  Place(std::atomic<int>& taken, int most) : taken_(taken), has_(++taken <= most) {}
  ~Place() { --taken_; }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  explicit operator bool() const { return has_; }

 private:
  std::atomic<int>& taken_;
  const bool has_;
};

grpc::Status TooMany(const char* what, int most) {
  return {grpc::StatusCode::RESOURCE_EXHAUSTED,
          fmt::format("{} {} are open already: close one", most, what)};
}

grpc::Status ToGrpc(const Error& error) {
  return {grpc::StatusCode::FAILED_PRECONDITION, error.message};
}

/// The station's version of the protocol; 0 where it did not say.
int ProtocolOf(const grpc::ServerContext& context) {
  const auto& metadata = context.client_metadata();
  const auto found = metadata.find(kProtocolKey);
  if (found == metadata.end() || found->second.size() > 9) return 0;
  int number = 0;
  for (const char c : found->second) {
    if (c < '0' || c > '9') return 0;
    number = 10 * number + (c - '0');
  }
  return number;
}

}  // namespace

HeadService::HeadService(HeadDesk& desk, PeerReader peer)
    : desk_(desk), cache_(desk.shelf()), fits_(desk.shelf()), peer_(std::move(peer)) {
  FORESIGHT_EXPECTS(peer_ != nullptr, "a service knows who calls");
}

void HeadService::Close() {
  closing_ = true;
}

Result<HeadDesk::Peer> HeadService::Admit(const grpc::ServerContext& context,
                                          grpc::Status* refusal) const {
  auto peer = peer_(context);
  if (!peer) {
    LogWarning("{}: refused: {}", context.peer(), peer.error().message);
    *refusal = {grpc::StatusCode::UNAUTHENTICATED, peer.error().message};
    return peer;
  }
  if (const int theirs = ProtocolOf(context); theirs != kLinkProtocol) {
    const Error error{ErrorCode::kState,
                      fmt::format("the station speaks version {} of the protocol and the head "
                                  "version {}: install the same Foresight on both",
                                  theirs, kLinkProtocol)};
    *refusal = ToGrpc(error);
    return tl::unexpected(error);
  }
  return peer;
}

grpc::Status HeadService::Identify(grpc::ServerContext* context,
                                   const link::IdentifyRequest* /*request*/,
                                   link::IdentifyReply* reply) {
  const auto peer = peer_(*context);
  if (!peer) return {grpc::StatusCode::UNAUTHENTICATED, peer.error().message};
  *reply = desk_.Identify(*peer);
  return grpc::Status::OK;
}

grpc::Status HeadService::Watch(grpc::ServerContext* context, WatchStream::Stream* stream) {
  grpc::Status refusal;
  if (!Admit(*context, &refusal)) return refusal;
  const Place place(watches_, kMostWatches);
  if (!place) return TooMany("streams of the status", kMostWatches);
  // A certificate may be revoked while the stream lasts.
  const auto still_good = [this, context] { return peer_(*context).has_value(); };
  WatchStream(desk_, *context, *stream, still_good).Run(closing_);
  return grpc::Status::OK;
}

grpc::Status HeadService::TakeControl(grpc::ServerContext* context,
                                      const link::ControlRequest* request,
                                      link::ControlReply* reply) {
  grpc::Status refusal;
  const auto peer = Admit(*context, &refusal);
  if (!peer) return refusal;
  *reply = desk_.TakeControl(*request, *peer);
  return grpc::Status::OK;
}

grpc::Status HeadService::ReleaseControl(grpc::ServerContext* context,
                                         const link::ReleaseRequest* request,
                                         link::ControlReply* reply) {
  grpc::Status refusal;
  if (!Admit(*context, &refusal)) return refusal;
  *reply = desk_.ReleaseControl(*request);
  return grpc::Status::OK;
}

grpc::Status HeadService::Execute(grpc::ServerContext* context, const link::Command* command,
                                  link::Outcome* outcome) {
  grpc::Status refusal;
  const auto peer = Admit(*context, &refusal);
  if (!peer) return refusal;
  *outcome = desk_.Execute(*command, *peer);
  return grpc::Status::OK;
}

grpc::Status HeadService::Stop(grpc::ServerContext* context, const link::StopRequest* request,
                               link::Outcome* outcome) {
  grpc::Status refusal;
  const auto peer = Admit(*context, &refusal);
  if (!peer) return refusal;
  *outcome = desk_.Stop(*peer, request->pressed_s());
  return grpc::Status::OK;
}

grpc::Status HeadService::GetRig(grpc::ServerContext* context, const link::RigRequest* request,
                                 link::RigReply* reply) {
  grpc::Status refusal;
  if (!Admit(*context, &refusal)) return refusal;
  const auto yaml = desk_.RigYaml(request->rig_id());
  if (!yaml) return ToGrpc(yaml.error());
  reply->set_yaml(*yaml);
  return grpc::Status::OK;
}

grpc::Status HeadService::GetStand(grpc::ServerContext* context,
                                   const link::StandRequest* /*request*/, link::StandReply* reply) {
  grpc::Status refusal;
  if (!Admit(*context, &refusal)) return refusal;
  if (desk_.Stand() == nullptr)
    return {grpc::StatusCode::FAILED_PRECONDITION,
            "the stand of this head is carried, it does not move by itself"};
  *reply = ToMessage(*desk_.Stand());
  return grpc::Status::OK;
}

grpc::Status HeadService::Transfer(grpc::ServerContext* context, TransferStream::Stream* stream) {
  grpc::Status refusal;
  const auto peer = Admit(*context, &refusal);
  if (!peer) return refusal;
  const Place place(transfers_, kMostTransfers);
  if (!place) return TooMany("transfers of scans", kMostTransfers);
  const auto still_good = [this, context] { return peer_(*context).has_value(); };
  return TransferStream(desk_.shelf(), cache_, desk_.bursts(), *peer, *context, *stream, still_good)
      .Run(closing_);
}

grpc::Status HeadService::Look(grpc::ServerContext* context, const link::LiveViewRequest* request,
                               LookStream::Stream* stream) {
  grpc::Status refusal;
  const auto peer = Admit(*context, &refusal);
  if (!peer) return refusal;
  if (!peer->may_operate && !desk_.Holder().empty())
    return {grpc::StatusCode::PERMISSION_DENIED,
            desk_.Holder() + " has control, and the camera: an observer would take it away"};
  const Place place(looks_, kMostLooks);
  if (!place) return TooMany("live views", kMostLooks);
  return LookStream(desk_, *context, *stream).Run(*request, closing_);
}

grpc::Status HeadService::FetchStops(grpc::ServerContext* context,
                                     const link::StopsRequest* request,
                                     grpc::ServerWriter<link::StopEvent>* stream) {
  grpc::Status refusal;
  if (!Admit(*context, &refusal)) return refusal;
  const Place place(looks_, kMostLooks);
  if (!place) return TooMany("live views and captures", kMostLooks);
  const auto stops = desk_.Stops(request->stops_id());
  if (!stops || request->from() < 0)
    return {grpc::StatusCode::NOT_FOUND, "the head does not have these captures any more"};
  for (int number = request->from(); !closing_ && !context->IsCancelled();) {
    const StopShelf::News news = stops->Wait(static_cast<std::size_t>(number), kServiceTick);
    if (!news.capture && !news.end) continue;
    const auto event = news.capture ? ToMessage(number, *news.capture)
                                    : ToMessage(number, news.end->state, news.end->reason);
    if (!event) return ToGrpc(event.error());
    if (!stream->Write(*event) || news.end) break;
    ++number;
  }
  return grpc::Status::OK;
}

grpc::Status HeadService::PublishPose(grpc::ServerContext* context,
                                      const link::PoseRequest* request, link::PoseReply* reply) {
  grpc::Status refusal;
  const auto peer = Admit(*context, &refusal);
  if (!peer) return refusal;
  const Place place(poses_, kMostPoses);
  if (!place) return TooMany("poses", kMostPoses);
  *reply = desk_.PublishPose(*request, *peer);
  return grpc::Status::OK;
}

grpc::Status HeadService::OpenBurst(grpc::ServerContext* context, const link::BurstRequest* request,
                                    link::BurstReply* reply) {
  grpc::Status refusal;
  const auto peer = Admit(*context, &refusal);
  if (!peer) return refusal;
  if (!peer->may_operate)
    return {grpc::StatusCode::PERMISSION_DENIED,
            peer->name + " is an observer: bursts are for operators"};
  auto opened = desk_.bursts().Open(*request, peer->name, context->peer());
  if (!opened) return ToGrpc(opened.error());
  *reply = std::move(*opened);
  return grpc::Status::OK;
}

grpc::Status HeadService::Fit(grpc::ServerContext* context, const link::FitRequest* request,
                              link::FitReply* reply) {
  grpc::Status refusal;
  const auto peer = Admit(*context, &refusal);
  if (!peer) return refusal;
  if (!peer->may_operate)
    return {grpc::StatusCode::PERMISSION_DENIED,
            peer->name + " is an observer: the head fits for operators"};
  const Place place(fitting_, kMostFits);
  if (!place) return TooMany("fits", kMostFits);
  context->set_compression_algorithm(GRPC_COMPRESS_GZIP);  // JSON, perhaps on a thin link
  auto fitted = fits_.Fit(*request, peer->name, [&] { return closing_ || context->IsCancelled(); });
  if (!fitted) return ToGrpc(fitted.error());
  *reply = std::move(*fitted);
  return grpc::Status::OK;
}

grpc::Status HeadService::FetchImage(grpc::ServerContext* context,
                                     const link::ImageRequest* request, link::ImageReply* reply) {
  grpc::Status refusal;
  if (!Admit(*context, &refusal)) return refusal;
  const Place place(images_, kMostImages);
  if (!place) return TooMany("images", kMostImages);
  const auto made = MakeImage(desk_.shelf(), *request);
  if (!made) return ToGrpc(made.error());
  *reply = *made;
  return grpc::Status::OK;
}

grpc::Status HeadService::ListScans(grpc::ServerContext* context,
                                    const link::ListScansRequest* /*request*/,
                                    link::ListScansReply* reply) {
  grpc::Status refusal;
  if (!Admit(*context, &refusal)) return refusal;
  for (const ShelvedScan& scan : desk_.shelf().List()) *reply->add_scans() = ToMessage(scan);
  return grpc::Status::OK;
}

}  // namespace foresight
