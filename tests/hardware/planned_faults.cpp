// The rows of the fault matrix: what is wrong with a device from its power-on.
#include "tests/hardware/fault_cell.h"

namespace foresight {
namespace {

constexpr bool kHarmless = true;

PlannedFault OfLidar(const std::string& name, std::vector<std::string> members,
                     const LidarFaults& faults, bool harmless) {
  PlannedFault planned{"lidar", name, {}, std::move(members), harmless};
  planned.plan.lidar = faults;
  return planned;
}

PlannedFault OfMotor(const std::string& name, std::vector<std::string> members,
                     const MotorFault& fault) {
  return {"motor", name, {.lidar = {}, .motor = {fault}, .camera = {}}, std::move(members), false};
}

PlannedFault OfCamera(const std::string& name, std::vector<std::string> members,
                      const CameraFaults& faults, bool harmless) {
  PlannedFault planned{"camera", name, {}, std::move(members), harmless};
  planned.plan.camera = faults;
  return planned;
}

}  // namespace

const std::vector<PlannedFault>& PlannedFaults() {
  static const std::vector<PlannedFault> kFaults = {
      OfLidar("5 % of the scans corrupt", {"seed", "corrupt_ratio"},
              {.seed = 7, .corrupt_fraction = 0.05}, false),
      OfLidar("3 % of the scans reset the connection", {"reset_ratio"},
              {.seed = 7, .reset_fraction = 0.03}, false),
      OfLidar("1 % of the scans are followed by 0.3 s of silence", {"stall_ratio", "stall_s"},
              {.seed = 7, .stall_fraction = 0.01, .stall_s = 0.3}, false),
      OfLidar("everything in pieces of 7 bytes", {"fragment_bytes"}, {.fragment_bytes = 7},
              kHarmless),
      OfLidar("3 s of booting", {"boot_delay_s"}, {.boot_delay_s = 3.0}, kHarmless),
      OfLidar("clock 500 ppm slow", {"clock_ppm"}, {.clock_ppm = -500.0}, kHarmless),
      OfLidar("clock 500 ppm fast", {"clock_ppm"}, {.clock_ppm = 500.0}, kHarmless),
      // The sweep begins after some two seconds and takes three.
      OfLidar("clock wraps after 3.5 s", {"clock_start_ms"}, {.clock_start_ms = 0xFFFFFF - 3500},
              kHarmless),
      OfLidar("clock jumps 1 h ahead after 3.5 s", {"clock_jump_s", "clock_jump_after_s"},
              {.clock_jump_s = 3600.0, .clock_jump_after_s = 3.5}, false),
      OfLidar("clock jumps 0.3 s back after 3.5 s", {"clock_jump_s", "clock_jump_after_s"},
              {.clock_jump_s = -0.3, .clock_jump_after_s = 3.5}, false),
      OfLidar("clock stands still after 3.5 s", {"clock_stop_after_s"}, {.clock_stop_after_s = 3.5},
              false),
      OfLidar("the last 10 beams are missing", {"missing_beams"}, {.missing_beams = 10}, false),
      OfLidar("abnormal until rebooted", {"abnormal"}, {.abnormal = true}, kHarmless),
      OfLidar("ignores the first QT", {"ignores_first_quit"}, {.ignores_first_quit = true},
              kHarmless),
      OfMotor("dead link for 0.6 s, 3.5 s after power-on", {"kind", "after_s", "duration_s"},
              {MotorFault::Kind::kDeadLink, 3.5, 0.6}),
      OfMotor("encoder 80 deg off for 1 s, 3.5 s after power-on", {"kind"},
              {MotorFault::Kind::kEncoderOffset, 3.5, 1.0}),
      OfCamera("5 % of the packets lost", {"seed", "packet_loss_ratio"},
               {.seed = kLossyCameraSeed, .packet_loss_ratio = 0.05}, kHarmless),
      OfCamera("every trigger ignored", {"ignored_trigger_ratio"},
               {.ignored_trigger_fraction = 1.0}, false),
      OfCamera("every image 3 s late", {"slow_frame_ratio", "slow_s"},
               {.slow_frame_fraction = 1.0, .slow_s = 3.0}, false),
      OfCamera("vanishes for 3 s, 1 s after power-on", {"vanish_after_s", "vanish_s"},
               {.vanish_after_s = 1.0, .vanish_s = 3.0}, false),
      OfCamera("clock 100 ppm fast, two days old", {"clock_ppm", "clock_start_s"},
               {.clock_ppm = 100.0, .clock_start_s = 172'800.0}, kHarmless),
      OfCamera("image numbers wrap", {"first_block"}, {.first_block = 65535}, kHarmless),
  };
  return kFaults;
}

std::vector<std::string> FaultPlanMembers() {
  // A binding names all members, or does not compile: who adds one adds its name below.
  [[maybe_unused]] const auto& [lidar_seed, corrupt_fraction, reset_fraction, stall_fraction,
                                stall_s, fragment_bytes, boot_delay_s, lidar_ppm, clock_start_ms,
                                clock_jump_s, clock_jump_after_s, clock_stop_after_s, missing_beams,
                                abnormal, ignores_first_quit] = LidarFaults();
  [[maybe_unused]] const auto& [kind, after_s, duration_s] = MotorFault();
  [[maybe_unused]] const auto& [camera_seed, packet_loss_ratio, ignored_trigger_fraction,
                                slow_frame_fraction, slow_s, vanish_after_s, vanish_s, camera_ppm,
                                clock_start_s, first_block] = CameraFaults();
  return {"lidar.seed",
          "lidar.corrupt_ratio",
          "lidar.reset_ratio",
          "lidar.stall_ratio",
          "lidar.stall_s",
          "lidar.fragment_bytes",
          "lidar.boot_delay_s",
          "lidar.clock_ppm",
          "lidar.clock_start_ms",
          "lidar.clock_jump_s",
          "lidar.clock_jump_after_s",
          "lidar.clock_stop_after_s",
          "lidar.missing_beams",
          "lidar.abnormal",
          "lidar.ignores_first_quit",
          "motor.kind",
          "motor.after_s",
          "motor.duration_s",
          "camera.seed",
          "camera.packet_loss_ratio",
          "camera.ignored_trigger_ratio",
          "camera.slow_frame_ratio",
          "camera.slow_s",
          "camera.vanish_after_s",
          "camera.vanish_s",
          "camera.clock_ppm",
          "camera.clock_start_s",
          "camera.first_block"};
}

}  // namespace foresight
