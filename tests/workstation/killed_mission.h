#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/running_program.h"

namespace foresight {

struct Acknowledged;

/// Kills a scripted mission at random moments and looks whether all that it had shown as kept is in
/// its file, once.
class KilledMission : public testing::Test {
 protected:
  /// @param driver_options go before the mission in mission_driver's command line
  explicit KilledMission(std::vector<std::string> driver_options = {})
      : driver_options_(std::move(driver_options)) {}

  /// A mission that ends in order: how long one takes, and something to review.
  void SetUp() override;

  /// Kills a mission at a moment that depends on the seed, and checks what is left of it.
  void KillAndCheck(std::uint64_t seed);

  double whole_mission_s_ = 0.0;
  int interrupted_ = 0;  ///< scans that a kill cut short

 private:
  std::vector<std::string> DriverArguments(std::vector<std::string> arguments) const;
  void WaitForTheMoment(std::uint64_t seed, const RunningProgram& driver) const;
  void ExpectOneCommandToGoOn(const std::filesystem::path& mission, bool mission_ended) const;
  void CheckMission(const std::filesystem::path& path, const Acknowledged& kept);
  void CheckReview(const std::filesystem::path& reviewed, const Acknowledged& kept) const;

  std::vector<std::string> driver_options_;
  TemporaryFolder folder_;
  std::filesystem::path other_ = folder_ / "other.foresight";
};

}  // namespace foresight
