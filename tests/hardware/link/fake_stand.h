#pragma once

#include <atomic>

#include "hardware/api/moving_stand.h"

namespace foresight {

/// A stand that is at once where it is told to be, and counts.
class FakeStand final : public MovingStand {
 public:
  const BoardMount& Mount() const override { return mount_; }
  const CalibrationBoard& SingleBoard() const override { return mount_.a; }
  const std::vector<Place>& Places() const override { return places_; }
  int At() const override { return at; }
  void MoveTo(int place) override {
    ++moves;
    at = place;
  }

  std::atomic<int> at{0};
  std::atomic<int> moves{0};

 private:
  const BoardMount mount_ = UsualBoardMount();
  const std::vector<Place> places_ = {{"view", false}, {"upright", true}, {"level", true}};
};

}  // namespace foresight
