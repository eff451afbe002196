#pragma once

#include <QRect>
#include <QTemporaryDir>
#include <memory>

#include "app/workstation/main_window.h"
#include "hardware/simulated/simulated_head.h"
#include "tests/display/stall_meter.h"
#include "tests/support/small_camera.h"

namespace foresight {

/// The main window on a fast simulated head that looks at resources/scenes/valve.yaml.
class RunningWindow {
 public:
  explicit RunningWindow(const SensorRig& rig = HalfCameraRig());
  /// On another world; the world's rig and options count, not those of `options`.
  RunningWindow(std::shared_ptr<const World> world, const SimulatedHeadOptions& options);
  ~RunningWindow();

  Workbench& bench() { return *bench_; }
  MainWindow& window() { return *window_; }
  /// From pressing the button to the depth on the screen.
  Stall WorstStallOfTheScan() const { return scan_stall_; }

  /// Presses the Scan button with the mouse and waits for the depth.
  bool ScanWithTheMouse();
  /// Two corners around the scene's valve, in pixels of the current image.
  std::pair<Eigen::Vector2d, Eigen::Vector2d> AroundValve();
  Eigen::Vector3d ValveInRobot() const;
  /// Draws what is pending.
  void Settle();

 private:
  QTemporaryDir missions_;
  std::shared_ptr<const World> world_;
  std::unique_ptr<Workbench> bench_;
  std::unique_ptr<MainWindow> window_;
  StallMeter stalls_;
  Stall scan_stall_;
};

}  // namespace foresight
