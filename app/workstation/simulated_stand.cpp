#include "app/workstation/simulated_stand.h"

#include <algorithm>

namespace foresight {
namespace {

class SimulatedStand : public MovingStand {
 public:
  SimulatedStand(std::shared_ptr<const World> world, BoardMount mount, CalibrationBoard single)
      : world_(std::move(world)), mount_(std::move(mount)), single_(std::move(single)) {
    const Scene& scene = world_->scene();
    for (const StandPlace& place : scene.places)
      places_.push_back(
          {place.name, scene.stands[static_cast<std::size_t>(place.stand)].b.has_value()});
  }

  const BoardMount& Mount() const override { return mount_; }
  const CalibrationBoard& SingleBoard() const override { return single_; }
  const std::vector<Place>& Places() const override { return places_; }
  // The world's places count from 1.
  int At() const override { return world_->StandAt() - 1; }
  void MoveTo(int place) override { (void)world_->MoveStand(place + 1); }

 private:
  std::shared_ptr<const World> world_;
  BoardMount mount_;
  CalibrationBoard single_;
  std::vector<Place> places_;
};

}  // namespace

std::shared_ptr<MovingStand> StandIn(std::shared_ptr<const World> world) {
  const Scene& scene = world->scene();
  const auto with_mount = std::find_if(scene.stands.begin(), scene.stands.end(),
                                       [](const BoardStand& stand) { return stand.b.has_value(); });
  if (with_mount == scene.stands.end() || scene.places.empty()) return nullptr;
  const auto single = std::find_if(scene.stands.begin(), scene.stands.end(),
                                   [](const BoardStand& stand) { return !stand.b; });
  // As drawn: how it was built is what the calibration finds out.
  const BoardMount mount = HingedMount(with_mount->a.board, with_mount->b->board, kHinge_m);
  return std::make_shared<SimulatedStand>(std::move(world), mount,
                                          single == scene.stands.end() ? mount.a : single->a.board);
}

}  // namespace foresight
