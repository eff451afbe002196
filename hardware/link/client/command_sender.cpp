#include "hardware/link/client/command_sender.h"

#include "core/sensor/scan.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kCommandPause{250};  ///< before a command is sent again
/// One try; a link whose round trip is longer carries no commands.
constexpr double kTry_s = 2.0;

}  // namespace

CommandSender::CommandSender(LinkSession& session, double good_s)
    : session_(session), good_s_(good_s) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

CommandSender::~CommandSender() {
  thread_ = {};
  for (const Waiting& waiting : waiting_)
    waiting.done({CommandEnd::Kind::kRefused,
                  {ErrorCode::kCancelled, "the program ended before it was sent"},
                  {}});
}

void CommandSender::Send(link::Command command, Done done) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back({std::move(command), std::move(done), LinkSession::Now()});
  wake_.notify_all();
}

void CommandSender::VoidMoves() {
  const std::lock_guard lock(mutex_);
  voided_s_ = LinkSession::Now();
  wake_.notify_all();
}

void CommandSender::Work(const std::stop_token& stop) {
  for (;;) {
    Waiting next;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return !waiting_.empty(); })) return;
      next = std::move(waiting_.front());
      waiting_.pop_front();
    }
    next.done(Carry(next, stop));
  }
}

CommandEnd CommandSender::Carry(const Waiting& waiting, const std::stop_token& stop) {
  link::Command command = waiting.command;
  command.set_command_id(NewUuid());
  const std::string boot_id = session_.HeadIdentity().boot_id();
  command.set_boot_id(boot_id);
  const double end_s = waiting.asked_s + good_s_;
  command.set_void_after_s(session_.DeskTime() + end_s - LinkSession::Now());
  command.set_given_s(session_.DeskTime() + waiting.asked_s - LinkSession::Now());
  const auto is_void = [&] { return Moves(command) && waiting.asked_s <= voided_s_; };
  bool sent = false;
  std::string trouble = "the link was lost";
  while (!stop.stop_requested() && LinkSession::Now() < end_s && !is_void()) {
    // A lease that was lost in a blackout is taken again before the command is.
    command.set_control_token(session_.Token());
    const double left_s = end_s - LinkSession::Now();
    link::Outcome outcome;
    const auto context = LinkSession::Context(
        std::chrono::milliseconds(static_cast<int>(1e3 * std::min(left_s, kTry_s)) + 1));
    const grpc::Status called = session_.stub(*context)->Execute(context.get(), command, &outcome);
    if (called.ok()) {
      session_.Heard(outcome.desk_time_s());
      const Status status = FromMessage(outcome);
      if (status) return {CommandEnd::Kind::kDone, {ErrorCode::kDevice, ""}, outcome};
      return {CommandEnd::Kind::kRefused, status.error(), outcome};
    }
    trouble = session_.ToError(called, "a command").message;
    // What the service itself refuses never reached the desk.
    if (called.error_code() != grpc::StatusCode::UNAVAILABLE &&
        called.error_code() != grpc::StatusCode::DEADLINE_EXCEEDED)
      return {CommandEnd::Kind::kRefused, session_.ToError(called, "a command"), {}};
    sent = true;
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, stop, kCommandPause, is_void);
  }
  if (!sent && is_void())
    return {CommandEnd::Kind::kRefused,
            {ErrorCode::kState, "the head was stopped before the command was sent: command again"},
            {}};
  if (!sent)
    return {CommandEnd::Kind::kRefused,
            {ErrorCode::kDevice, fmt::format("{}: the command waited {:.0f} s for others and was "
                                             "not sent: command again",
                                             session_.address(), good_s_)},
            {}};
  return {CommandEnd::Kind::kUnknown, {ErrorCode::kDevice, trouble}, {}};
}

}  // namespace foresight
