#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "hardware/link/client/link_session.h"

namespace foresight {

/// The head as the station knows it: what it said last and, while a command is on its way, the
/// state that the command asks for, so that nobody takes the old one for the answer. Safe from any
/// thread.
class HeadMirror {
 public:
  explicit HeadMirror(std::string address) : address_(std::move(address)) {}

  /// The head said this; words that are older than what is known are left out.
  Status Take(const link::Status& status, double desk_time_s);
  /// The head's program was started anew: its times begin at zero.
  void Forget();
  void Lost(const Error& error);

  /// A command is on its way that leads to `state`.
  void Ask(HeadState state, const std::string& message);
  /// Its end is known; a message of ours stands until the head says something else.
  void Answered();
  void Tell(const std::string& message);

  HeadStatus Now() const;
  std::string ScanOnHead() const;
  /// Since the head's last word.
  double Age() const;
  bool Connected() const;
  std::string Trouble() const;

 private:
  const std::string address_;
  mutable std::mutex mutex_;
  HeadStatus said_;
  std::string scan_id_;
  double desk_time_s_ = -1.0;
  double heard_s_ = LinkSession::Now();
  std::optional<HeadState> asked_;
  std::string asked_message_;
  std::string own_message_;  ///< beside what the head said then
  std::string message_then_;
  std::string trouble_;  ///< empty while the link is there
};

}  // namespace foresight
