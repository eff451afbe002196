#include "hardware/link/client/fit_client.h"

#include <thread>

#include "core/sensor/scan.h"
#include "hardware/link/protocol/messages.h"

namespace foresight {
namespace {

constexpr double kGood_s = 120.0;
/// A fit with its depth map takes some seconds, its answer 3 s at 9600 bit/s.
constexpr std::chrono::milliseconds kFitTry{60'000};
constexpr std::chrono::milliseconds kCancelTry{3'000};
constexpr std::chrono::milliseconds kFitPause{200};

link::ImageChoice ToMessage(HeadFitOrder::Image image) {
  switch (image) {
    case HeadFitOrder::Image::kAsSaid:
      return link::AS_THE_PROVENANCE_SAYS;
    case HeadFitOrder::Image::kNearest:
      return link::NEAREST_TO_THE_REGION;
    case HeadFitOrder::Image::kMiddle:
      break;
  }
  return link::IN_THE_MIDDLE;
}

/// So that the head does not go on for nobody; where it does not hear it, it ends by itself.
void TellCancelled(LinkSession& session, link::FitRequest request) {
  request.set_cancel(true);
  request.clear_provenance_json();
  link::FitReply ignored;
  const auto context = LinkSession::Context(kCancelTry);
  session.stub(*context)->Fit(context.get(), request, &ignored);
}

Result<HeadFit> FromReply(const link::FitRequest& request, const link::FitReply& reply) {
  if (reply.has_failure()) {
    FORESIGHT_CHECK(FromMessage(reply.failure()));
    return Fail(ErrorCode::kBadData, "the head answers with a failure that is none");
  }
  return HeadFit{reply.detection_json(),
                 reply.provenance_json(),
                 reply.scan_state(),
                 reply.scan_reason(),
                 static_cast<std::int64_t>(request.ByteSizeLong()),
                 static_cast<std::int64_t>(reply.ByteSizeLong())};
}

}  // namespace

Result<HeadFit> FitOnHead(LinkSession& session, const HeadFitOrder& order,
                          const RunContext& context) {
  const double end_s = LinkSession::Now() + kGood_s;
  link::FitRequest request;
  request.set_command_id(NewUuid());
  request.set_scan_id(order.scan_id);
  request.set_provenance_json(order.provenance_json);
  request.set_image(ToMessage(order.image));
  context.Report(0.0, "waiting for the head");
  for (;;) {
    link::FitReply reply;
    const auto call = LinkSession::Context(kFitTry);
    call->set_compression_algorithm(GRPC_COMPRESS_GZIP);
    const std::stop_callback cancel(context.stop, [&] { call->TryCancel(); });
    const grpc::Status called = session.stub(*call)->Fit(call.get(), request, &reply);
    if (called.ok()) return FromReply(request, reply);
    if (context.Cancelled()) {
      TellCancelled(session, request);
      return Fail(ErrorCode::kCancelled, "the fit on the robot was cancelled");
    }
    const bool lost = called.error_code() == grpc::StatusCode::UNAVAILABLE ||
                      called.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED;
    if (!lost || LinkSession::Now() > end_s)
      return tl::unexpected(session.ToError(called, "a fit on the robot"));
    std::this_thread::sleep_for(kFitPause);
  }
}

}  // namespace foresight
