#include "hardware/link/client/stops_client.h"

#include <condition_variable>
#include <mutex>

#include "hardware/link/protocol/stop_messages.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kStopsPause{250};

}  // namespace

StopsClient::StopsClient(LinkSession& session, std::string stops_id, std::shared_ptr<StopSink> sink)
    : session_(session), stops_id_(std::move(stops_id)), sink_(std::move(sink)) {}

StopsClient::~StopsClient() {
  thread_ = {};
  End(ScanState::kInterrupted, "the program ended before all captures had come");
}

void StopsClient::Started() {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

void StopsClient::Refuse(const std::string& reason) {
  End(ScanState::kAborted, reason);
}

void StopsClient::End(ScanState state, const std::string& reason) {
  if (!ended_.exchange(true)) sink_->OnStopsEnded(state, reason);
}

void StopsClient::Work(const std::stop_token& stop) {
  link::StopsRequest request;
  request.set_stops_id(stops_id_);
  for (int next = 0; !stop.stop_requested() && !ended_;) {
    request.set_from(next);
    const auto context = LinkSession::Context(std::chrono::milliseconds(0));
    const std::stop_callback cancel(stop, [&] { context->TryCancel(); });
    const auto stub = session_.WaitForStub(stop);
    if (stub == nullptr) return;
    const auto stream = stub->FetchStops(context.get(), request);
    link::StopEvent event;
    while (!ended_ && stream->Read(&event)) {
      if (event.ended()) {
        const auto state = ScanStateFromString(event.state());
        End(state ? *state : ScanState::kInterrupted, event.reason());
      } else if (const auto capture = CaptureFromMessage(event);
                 capture && event.number() == next) {
        sink_->OnStop(*capture);
        ++next;
      } else {
        End(ScanState::kInterrupted,
            capture ? "a capture is missing on the link" : capture.error().message);
      }
    }
    context->TryCancel();
    const grpc::Status status = stream->Finish();
    if (status.error_code() == grpc::StatusCode::NOT_FOUND)
      End(ScanState::kInterrupted, status.error_message());
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait_for(lock, stop, kStopsPause,
                                           [this] { return ended_.load(); });
  }
}

}  // namespace foresight
