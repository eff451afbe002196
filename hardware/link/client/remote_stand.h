#pragma once

#include <functional>
#include <mutex>
#include <optional>

#include "hardware/link/client/command_sender.h"
#include "hardware/link/protocol/stand_messages.h"

namespace foresight {

/// The moving stand of a simulated head at the far end of a link.
class RemoteStand final : public MovingStand, public std::enable_shared_from_this<RemoteStand> {
 public:
  using Send = std::function<void(link::Command, CommandSender::Done)>;

  RemoteStand(StandDescription stand, Send send)
      : stand_(std::move(stand)), send_(std::move(send)), at_(stand_.at) {}

  const BoardMount& Mount() const override { return stand_.mount; }
  const CalibrationBoard& SingleBoard() const override { return stand_.single_board; }
  const std::vector<Place>& Places() const override { return stand_.places; }
  int At() const override;
  void MoveTo(int place) override;
  bool Moving() const override;
  std::string Trouble() const override;

  /// The head says where it is, from 1; 0 = away. What it said before a move's end is left out.
  void Heard(int at, double desk_time_s);
  /// The head's program was started anew: its times begin at zero.
  void Forget();
  /// The link is gone, and the stand stays where it is.
  void Leave();

 private:
  void End(int place, const CommandEnd& end);

  const StandDescription stand_;
  mutable std::mutex mutex_;  ///< guards what follows
  Send send_;                 ///< null = the link is gone
  int at_;
  std::optional<int> asked_;
  std::string trouble_;
  double known_desk_s_ = -1.0;
};

}  // namespace foresight
