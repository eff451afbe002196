#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/calibration/checkerboard_finder.h"
#include "core/calibration/session_index.h"
#include "core/io/yaml_reader.h"

namespace foresight {

/// The keys `image` and `corners`, of which a view has one at the most, and `origin`. Files lie in
/// the folder of the file that names them, or below.
SessionViewFiles ViewFromYaml(YamlMap& map);
/// The name of a file in that folder; else it is a fault of the map.
std::string FileNameFromYaml(YamlMap& map, const std::string& key);
/// The same; empty where the key is missing.
std::string OptionalFileNameFromYaml(YamlMap& map, const std::string& key);
CalibrationBoard BoardFromYaml(YamlMap& map, const std::string& key);

/// A pose, of length 1 but for rounding.
template <class To, class From>
Rigid<To, From> PoseFromYaml(YamlMap map) {
  const std::vector<double> q = map.Numbers("quaternion_wxyz", 4);
  const Eigen::Vector3d t = map.Vector("translation_m");
  map.Finish();
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  if (std::abs(rotation.norm() - 1.0) > 1e-3) map.Fault("quaternion_wxyz does not have length 1");
  return {rotation, t};
}

/// Reads the corners, or looks for the boards in the image, for two with DetectMount. Fails with
/// kIo, and with kBadData, naming the file; an image has the size of the camera.
Result<MountView> ReadView(const std::filesystem::path& folder, const SessionViewFiles& files,
                           const CameraModel& camera, const BoardMount& mount, SearchEffort effort);

}  // namespace foresight
