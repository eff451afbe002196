#include "app/common/simulated_stand.h"

#include <algorithm>

#include "core/base/contract.h"

namespace foresight {
namespace {

class SimulatedStand : public MovingStand {
 public:
  SimulatedStand(std::shared_ptr<const World> world, BoardMount mount, CalibrationBoard single)
      : world_(std::move(world)), mount_(std::move(mount)), single_(std::move(single)) {
    const Scene& scene = world_->scene();
    for (std::size_t i = 0; i < scene.places.size(); ++i) {
      const BoardStand& stand = scene.stands[static_cast<std::size_t>(scene.places[i].stand)];
      if (!IsShown(stand)) continue;
      places_.push_back({scene.places[i].name, stand.b.has_value()});
      numbers_.push_back(static_cast<int>(i) + 1);
    }
  }

  const BoardMount& Mount() const override { return mount_; }
  const CalibrationBoard& SingleBoard() const override { return single_; }
  const std::vector<Place>& Places() const override { return places_; }
  int At() const override {
    const auto at = std::find(numbers_.begin(), numbers_.end(), world_->StandAt());
    return at == numbers_.end() ? -1 : static_cast<int>(at - numbers_.begin());
  }
  void MoveTo(int place) override {
    const Status moved =
        world_->MoveStand(place < 0 ? 0 : numbers_[static_cast<std::size_t>(place)]);
    FORESIGHT_EXPECTS(moved.has_value(), "a place of the world");
  }

 private:
  /// A scene may have stands with other boards too: a session has those of one.
  bool IsShown(const BoardStand& stand) const {
    return stand.b ? stand.a.board == mount_.a && stand.b->board == *mount_.b
                   : stand.a.board == single_;
  }

  std::shared_ptr<const World> world_;
  BoardMount mount_;
  CalibrationBoard single_;
  std::vector<Place> places_;
  std::vector<int> numbers_;  ///< of places_ in the world, from 1; 0 = the stands are away
};

}  // namespace

std::shared_ptr<MovingStand> StandIn(std::shared_ptr<const World> world) {
  const Scene& scene = world->scene();
  const auto with_mount = std::find_if(scene.stands.begin(), scene.stands.end(),
                                       [](const BoardStand& stand) { return stand.b.has_value(); });
  if (with_mount == scene.stands.end() || scene.places.empty()) return nullptr;
  const auto single = std::find_if(scene.stands.begin(), scene.stands.end(),
                                   [](const BoardStand& stand) { return !stand.b; });
  const BoardMount mount = with_mount->Mount();
  return std::make_shared<SimulatedStand>(std::move(world), mount,
                                          single == scene.stands.end() ? mount.a : single->a.board);
}

}  // namespace foresight
