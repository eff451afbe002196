#pragma once

#include <filesystem>
#include <string>

#include "core/sensor/sensor_rig.h"
#include "hardware/api/camera.h"
#include "hardware/gige/gige_camera_options.h"
#include "hardware/head/capture_options.h"
#include "hardware/motor/modbus_motor_options.h"
#include "hardware/scip/scip_lidar_options.h"

namespace foresight {

/// Everything that a program must know of a real head: where its devices are, how they are driven,
/// and its calibration. One YAML file a head, docs/formats.md.
struct HeadConfig {
  std::string name = "head";  ///< stands in every scan as its source
  /// The devices are emulated: scans are marked as simulated.
  bool simulated = false;
  SensorRig rig = DefaultSensorRig();
  ScipLidarOptions lidar;
  ModbusMotorOptions motor;
  GigeCameraOptions camera;
  CameraSettings exposure;  ///< of plans that do not say otherwise
  CaptureOptions capture;
};

/// `folder` is where a relative `rig` is looked for. Every key but `foresight_head` and the three
/// addresses has a default. Fails with kBadData, naming `source`, the line and the key.
Result<HeadConfig> HeadConfigFromYaml(const std::string& yaml, const std::string& source,
                                      const std::filesystem::path& folder);
/// Also fails with kIo.
Result<HeadConfig> LoadHeadConfig(const std::filesystem::path& path);

/// What HeadConfigFromYaml reads back; `rig_file` is where the caller puts the rig.
std::string HeadConfigToYaml(const HeadConfig& config, const std::string& rig_file);
/// Writes the configuration and, beside it, its rig: head.yaml and head.rig.yaml. Fails with kIo.
Status SaveHeadConfig(const HeadConfig& config, const std::filesystem::path& path);

}  // namespace foresight
