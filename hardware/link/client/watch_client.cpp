#include "hardware/link/client/watch_client.h"

#include <condition_variable>

#include "core/base/log.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kIdentify{10'000};  ///< a first call takes 4 s at 9600 bit/s
constexpr std::chrono::milliseconds kWatchPause{250};   ///< before the next try
constexpr double kSignEvery_s = 1.0;
constexpr double kThere_s = 1.5;  ///< who was seen so long ago is not there any more
constexpr std::chrono::milliseconds kWatchTick{50};

}  // namespace

WatchClient::WatchClient(LinkSession& session, double status_rate_hz, Hooks hooks)
    : session_(session), status_rate_hz_(status_rate_hz), hooks_(std::move(hooks)) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

WatchClient::~WatchClient() = default;

void WatchClient::Work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (const Status watched = Watch(stop); !watched && !stop.stop_requested())
      hooks_.on_lost(watched.error());
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait_for(lock, stop, kWatchPause, [] { return false; });
  }
}

/// Until the stream breaks.
Status WatchClient::Watch(const std::stop_token& stop) {
  FORESIGHT_CHECK(session_.Begin(kIdentify));
  if (hooks_.on_begin) hooks_.on_begin();
  const auto context = LinkSession::Context(std::chrono::milliseconds(0));
  const std::stop_callback cancel(stop, [&] { context->TryCancel(); });
  const auto stub = session_.WaitForStub(stop);
  if (stub == nullptr) return {};
  const auto stream = stub->Watch(context.get());
  std::jthread signer([&](const std::stop_token& ended) { Sign(ended, *stream); });
  link::Event event;
  while (stream->Read(&event)) {
    session_.Heard(event.desk_time_s());
    {
      const std::lock_guard lock(mutex_);
      if (event.answers() == number_ && signed_s_ > 0.0) {
        session_.SetRoundTrip(LinkSession::Now() - signed_s_);
        signed_s_ = 0.0;
      }
    }
    hooks_.on_event(event);
  }
  signer.request_stop();
  signer.join();
  const grpc::Status ended = stream->Finish();
  return tl::unexpected(session_.ToError(ended, "the stream of its status"));
}

void WatchClient::Sign(const std::stop_token& stop,
                       grpc::ClientReaderWriter<link::SignOfLife, link::Event>& stream) {
  double next_s = 0.0;
  std::mutex mutex;
  std::condition_variable_any wake;
  while (!stop.stop_requested()) {
    const double now_s = LinkSession::Now();
    if (now_s >= next_s) {
      next_s = now_s + kSignEvery_s;
      link::SignOfLife sign;
      sign.set_status_rate_hz(status_rate_hz_);
      if (now_s - seen_s_ < kThere_s) sign.set_control_token(session_.Token());
      {
        const std::lock_guard lock(mutex_);
        sign.set_number(++number_);
        signed_s_ = now_s;
      }
      if (!stream.Write(sign)) return;
    }
    std::unique_lock lock(mutex);
    wake.wait_for(lock, stop, kWatchTick, [] { return false; });
  }
}

}  // namespace foresight
