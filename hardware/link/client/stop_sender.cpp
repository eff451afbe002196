#include "hardware/link/client/stop_sender.h"

#include "core/base/log.h"

namespace foresight {
namespace {

constexpr double kGiveUp_s = 60.0;
/// One try; longer than that of a command: over a link that carries commands a stop is confirmed.
constexpr std::chrono::milliseconds kStopTry{2500};
constexpr std::chrono::milliseconds kStopPause{100};

/// @param pressed_s LinkSession::Now() when it was pressed
grpc::Status SendOnce(LinkSession& session, double pressed_s, link::Outcome& outcome) {
  const auto context = LinkSession::Context(kStopTry);
  link::StopRequest request;
  request.set_pressed_s(session.DeskTime() + pressed_s - LinkSession::Now());
  return session.stub(*context)->Stop(context.get(), request, &outcome);
}

}  // namespace

Result<HeadStatus> StopHead(LinkSession& session, std::chrono::milliseconds patience,
                            const RunContext& context) {
  const double pressed_s = LinkSession::Now();
  const double end_s = pressed_s + 1e-3 * static_cast<double>(patience.count());
  for (;;) {
    link::Outcome outcome;
    const grpc::Status called = SendOnce(session, pressed_s, outcome);
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

StopSender::StopSender(LinkSession& session, std::function<void(const link::Outcome&)> on_answer)
    : session_(session), on_answer_(std::move(on_answer)) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

void StopSender::Stop() {
  const std::lock_guard lock(mutex_);
  ++asked_;
  pressed_s_ = LinkSession::Now();
  answer_ = StopAnswer::kWaiting;
  wake_.notify_all();
}

StopAnswer StopSender::Answer() const {
  const std::lock_guard lock(mutex_);
  return answer_;
}

StopAnswer StopSender::AnswerTo(const grpc::Status& called, const link::Outcome& outcome,
                                double end_s) {
  if (called.ok()) {
    const Status obeyed = FromMessage(outcome);
    if (!obeyed) LogError("{}: {}", session_.address(), obeyed.error().message);
    if (on_answer_) on_answer_(outcome);
    return obeyed ? StopAnswer::kObeyed : StopAnswer::kRefused;
  }
  session_.Doubt();  // it may hang in a blackout that is over
  if (LinkSession::Now() <= end_s) return StopAnswer::kWaiting;
  LogError("{}", session_.ToError(called, "stopping the head").message);
  return StopAnswer::kUnknown;
}

void StopSender::Work(const std::stop_token& stop) {
  for (;;) {
    int asked = 0;
    double pressed_s = 0.0;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return asked_ != answered_; })) return;
      asked = asked_;
      pressed_s = pressed_s_;
    }
    const double end_s = LinkSession::Now() + kGiveUp_s;
    StopAnswer answer = StopAnswer::kWaiting;
    do {  // a stop that was pressed when the program ends is sent once
      link::Outcome outcome;
      const grpc::Status called = SendOnce(session_, pressed_s, outcome);
      answer = AnswerTo(called, outcome, end_s);
      std::unique_lock lock(mutex_);
      if (answer == StopAnswer::kWaiting)
        wake_.wait_for(lock, stop, kStopPause, [&] { return asked_ != asked; });
    } while (answer == StopAnswer::kWaiting && !stop.stop_requested());
    const std::lock_guard lock(mutex_);
    answered_ = asked;
    // A stop that was pressed meanwhile waits for its own answer.
    if (asked_ == asked) answer_ = answer;
  }
}

}  // namespace foresight
