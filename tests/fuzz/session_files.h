#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "core/sensor/sensor_rig.h"
#include "tests/fuzz/require.h"
#include "tests/support/temporary_folder.h"

namespace foresight {

/// A rig whose lidar has so few beams that a line is a short row.
inline SensorRig RigOfFewBeams() {
  SensorRig rig = DefaultSensorRig();
  rig.lidar.beams = 4;
  return rig;
}

/// A folder of one session whose files are good, but for the one that is being fuzzed.
class SessionFiles {
 public:
  SessionFiles() {
    Write("rig.yaml", SensorRigToYaml(RigOfFewBeams()));
    Reset();
  }

  void Reset() {
    Write("session.yaml",
          "foresight_calibration_session: 1\nname: fuzz\nrig: rig.yaml\n"
          "mount: {a: 'checkerboard:3x4:50'}\nposes:\n"
          "  - {name: one, stops: [{motor_deg: 0, corners: corners.csv, lines: lines.csv}],"
          " sweep: {lines: lines.csv, motor: motor.csv}}\n");
    Write("corners.csv", "board,corner,u,v\na,0,100,100\na,1,150,100\n");
    Write("lines.csv",
          "seq,time_s,range_mm\n1,0,1000,1001,1002,1003\n2,0.025,1000,1001,1002,1003\n");
    Write("motor.csv", "time_s,angle_rad\n0,0\n0.01,0.001\n0.02,0.002\n");
  }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream file(folder_ / name, std::ios::binary);  // nobody waits for the disk here
    Require(static_cast<bool>(file << text), "the folder can be written");
  }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

}  // namespace foresight
