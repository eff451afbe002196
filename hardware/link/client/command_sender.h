#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "hardware/link/client/link_session.h"

namespace foresight {

/// What became of a command.
struct CommandEnd {
  enum class Kind {
    kDone,     ///< the head carried it out
    kRefused,  ///< the head did not, and never will
    kUnknown,  ///< no answer came while the command was good: it may have been carried out
  };
  Kind kind = Kind::kUnknown;
  Error error{ErrorCode::kDevice, ""};  ///< unless done
  link::Outcome outcome;                ///< of the head, unless unknown
};

/// Sends commands to a head, one after the other, from a thread of its own. A command is good for
/// a limited time: until then it is sent again where the link broke, which the head notices and
/// carries it out once; then it is void, at the head too.
class CommandSender {
 public:
  using Done = std::function<void(const CommandEnd&)>;

  /// `session` outlives it.
  explicit CommandSender(LinkSession& session, double good_s);
  /// Commands that wait end as refused.
  ~CommandSender();

  /// Returns at once; id, token, time and boot id are filled in when it is sent. `done` is called
  /// from the sender's thread.
  void Send(link::Command command, Done done);

  /// The head is to stop: what would move it and was not carried out yet is not sent (again), and
  /// ends as refused or, where it was sent, as unknown.
  void VoidMoves();

 private:
  struct Waiting {
    link::Command command;
    Done done;
    double asked_s = 0.0;
  };
  void Work(const std::stop_token& stop);
  CommandEnd Carry(const Waiting& waiting, const std::stop_token& stop);

  LinkSession& session_;
  const double good_s_;
  std::atomic<double> voided_s_ = -1.0;  ///< moves that were asked for until then are void
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<Waiting> waiting_;
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
