#include "hardware/assembly/real_head.h"

#include "hardware/gige/gige_camera.h"
#include "hardware/head/capture_head.h"
#include "hardware/head/real_time_clock.h"
#include "hardware/motor/modbus_motor.h"
#include "hardware/scip/scip_lidar.h"

namespace foresight {

HeadDevices MakeDrivers(const HeadConfig& config, std::shared_ptr<SensorClock> clock) {
  HeadDevices devices;
  devices.lidar = std::make_unique<ScipLidar>(config.lidar, clock);
  devices.camera = std::make_unique<GigeCamera>(config.camera, clock);
  devices.motor = std::make_unique<ModbusMotor>(config.motor, clock);
  devices.clock = std::move(clock);
  return devices;
}

std::unique_ptr<SensorHead> MakeRealHead(const HeadConfig& config) {
  return std::make_unique<CaptureHead>(MakeDrivers(config, std::make_shared<RealTimeClock>()),
                                       config.rig, config.capture);
}

}  // namespace foresight
