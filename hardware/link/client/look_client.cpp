#include "hardware/link/client/look_client.h"

#include <cmath>
#include <condition_variable>
#include <mutex>

#include "core/io/jpeg.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kLookPause{500};

}  // namespace

LookClient::LookClient(LinkSession& session, const LiveViewOptions& options,
                       std::shared_ptr<LiveViewSink> sink)
    : session_(session), request_(ToMessage(options)), sink_(std::move(sink)) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

void LookClient::Work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto context = LinkSession::Context(std::chrono::milliseconds(0));
    const std::stop_callback cancel(stop, [&] { context->TryCancel(); });
    const auto stub = session_.WaitForStub(stop);
    if (stub == nullptr) return;
    const auto stream = stub->Look(context.get(), request_);
    link::LiveViewImage message;
    while (stream->Read(&message)) Show(message);
    const grpc::Status ended = stream->Finish();
    if (stop.stop_requested()) return;
    if (!ended.ok()) sink_->OnLiveViewTrouble(session_.ToError(ended, "the live view").message);
    // Two stations that take it from each other would never end.
    if (ended.error_code() == grpc::StatusCode::ABORTED ||
        ended.error_code() == grpc::StatusCode::PERMISSION_DENIED ||
        ended.error_code() == grpc::StatusCode::INVALID_ARGUMENT)
      return;
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait_for(lock, stop, kLookPause, [] { return false; });
  }
}

void LookClient::Show(const link::LiveViewImage& message) {
  if (!message.trouble().empty()) sink_->OnLiveViewTrouble(message.trouble());
  if (message.jpeg().empty()) return;
  auto image = DecodeJpeg(message.jpeg(), "the live view");
  if (!image || !std::isfinite(message.time_s()) || !std::isfinite(message.motor_angle_rad()) ||
      message.full_width() < 1 || message.full_height() < 1)
    return sink_->OnLiveViewTrouble(image ? "the live view: its numbers are none"
                                          : image.error().message);
  LiveImage shown;
  shown.image = std::move(*image);
  shown.time_s = message.time_s();
  shown.motor_angle_rad = message.motor_angle_rad();
  shown.full_width = message.full_width();
  shown.full_height = message.full_height();
  sink_->OnLiveImage(shown);
}

}  // namespace foresight
