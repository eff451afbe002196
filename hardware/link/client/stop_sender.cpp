#include "hardware/link/client/stop_sender.h"

#include "core/base/log.h"

namespace foresight {
namespace {

constexpr double kGiveUp_s = 60.0;
constexpr std::chrono::milliseconds kStopTry{1500};
constexpr std::chrono::milliseconds kStopPause{100};

grpc::Status SendOnce(LinkSession& session, link::Outcome& outcome) {
  const auto context = LinkSession::Context(kStopTry);
  return session.stub(*context)->Stop(context.get(), link::StopRequest(), &outcome);
}

}  // namespace

Result<HeadStatus> StopHead(LinkSession& session, std::chrono::milliseconds patience,
                            const RunContext& context) {
  const double end_s = LinkSession::Now() + 1e-3 * static_cast<double>(patience.count());
  for (;;) {
    link::Outcome outcome;
    const grpc::Status called = SendOnce(session, outcome);
    if (called.ok()) {
      FORESIGHT_CHECK(FromMessage(outcome));
      return FromMessage(outcome.status(), {});
    }
    if (context.Cancelled())
      return Fail(ErrorCode::kCancelled, "{}: cancelled; the head has not answered the stop",
                  session.address());
    const bool lost = called.error_code() == grpc::StatusCode::UNAVAILABLE ||
                      called.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED;
    if (!lost || LinkSession::Now() > end_s)
      return tl::unexpected(session.ToError(called, "stopping the head"));
    std::this_thread::sleep_for(kStopPause);
  }
}

StopSender::StopSender(LinkSession& session) : session_(session) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

void StopSender::Stop() {
  const std::lock_guard lock(mutex_);
  ++asked_;
  wake_.notify_all();
}

bool StopSender::Answered() const {
  const std::lock_guard lock(mutex_);
  return asked_ == answered_;
}

void StopSender::Work(const std::stop_token& stop) {
  for (;;) {
    int asked = 0;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return asked_ != answered_; })) return;
      asked = asked_;
    }
    const double end_s = LinkSession::Now() + kGiveUp_s;
    for (bool answered = false; !answered;) {
      link::Outcome outcome;
      const grpc::Status called = SendOnce(session_, outcome);
      answered = called.ok() || stop.stop_requested();
      if (!called.ok() && LinkSession::Now() > end_s) {
        LogError("{}", session_.ToError(called, "stopping the head").message);
        answered = true;
      }
      if (!called.ok()) session_.Doubt();  // it may hang in a blackout that is over
      std::unique_lock lock(mutex_);
      if (answered)
        answered_ = asked;
      else
        wake_.wait_for(lock, stop, kStopPause, [&] { return asked_ != asked; });
    }
  }
}

}  // namespace foresight
