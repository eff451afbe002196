// The rows of the fault matrix: what begins while a head runs.
#include "hardware/net/tcp_socket.h"
#include "tests/hardware/fault_cell.h"

namespace foresight {
namespace {

HeadFault Of(const std::string& device, const std::string& name,
             const std::function<void(EmulatedDevices&)>& begin, double lasts_s,
             const std::function<void(EmulatedDevices&)>& heal, std::vector<HeadPhase> unmet) {
  return {device,
          name,
          [begin](EmulatedDevices& devices) {
            begin(devices);
            return std::jthread();
          },
          lasts_s,
          heal,
          std::move(unmet)};
}

using Phase = HeadPhase;

/// When the head stops, the last lines and the image have just come.
HeadFault OfLidar(const std::string& name, const std::function<void(ScipEmulator&)>& begin,
                  double lasts_s, std::vector<HeadPhase> unmet = {Phase::kStopping}) {
  return Of(
      "lidar", name, [begin](EmulatedDevices& devices) { begin(devices.lidar()); }, lasts_s,
      [](EmulatedDevices& devices) { devices.lidar().ClearFaults(); }, std::move(unmet));
}

HeadFault OfCamera(const std::string& name, const std::function<void(CameraEmulator&)>& begin,
                   double lasts_s) {
  return Of(
      "camera", name, [begin](EmulatedDevices& devices) { begin(devices.camera()); }, lasts_s,
      [](EmulatedDevices& devices) { devices.camera().ClearFaults(); }, {Phase::kStopping});
}

/// Long enough to be met in every state; the switch is only looked at while homing.
double DurationOf(MotorFault::Kind kind) {
  switch (kind) {
    case MotorFault::Kind::kBlockedShaft:
      return 1.0;
    case MotorFault::Kind::kLostHomeSwitch:
      return 6.0;
    case MotorFault::Kind::kDeadLink:
    case MotorFault::Kind::kStaleStatus:
    case MotorFault::Kind::kEncoderOffset:
      return 2.0;
    case MotorFault::Kind::kTcpReset:
      break;
  }
  return 0.0;
}

/// Where nothing is there that the fault could change.
std::vector<HeadPhase> UnmetBy(MotorFault::Kind kind) {
  switch (kind) {
    case MotorFault::Kind::kBlockedShaft:
      return {Phase::kReady};  // nothing turns for its second
    case MotorFault::Kind::kStaleStatus:
      return {Phase::kSweeping};  // the bits stay as they are while the shaft turns
    case MotorFault::Kind::kTcpReset:
      return {Phase::kDisconnected, Phase::kConnecting, Phase::kFault};  // no connection to break
    case MotorFault::Kind::kLostHomeSwitch:
      return {Phase::kStopping};
    case MotorFault::Kind::kDeadLink:
    case MotorFault::Kind::kEncoderOffset:
      break;
  }
  return {};
}

HeadFault OfMotor(MotorFault::Kind kind) {
  const double lasts_s = DurationOf(kind);
  return Of(
      "motor", ToString(kind),
      [kind, lasts_s](EmulatedDevices& devices) {
        devices.motor().Inject({kind, 0.0, lasts_s});
      },
      lasts_s, [](EmulatedDevices& devices) { devices.motor().ClearFaults(); }, UnmetBy(kind));
}

constexpr double kStays_s = 3.0;

std::vector<HeadPhase> AllPhases() {
  std::vector<HeadPhase> phases;
  for (int i = 0; i < kHeadPhases; ++i) phases.push_back(static_cast<HeadPhase>(i));
  return phases;
}

/// Somebody else connects to the lidar, which serves one client, and stays for a while if it can.
HeadFault SecondClientOfTheLidar() {
  const auto begin = [](EmulatedDevices& devices) {
    return std::jthread([address = devices.lidar().address()](const std::stop_token& stop) {
      const auto client = TcpSocket::Connect(address, std::chrono::milliseconds(200));
      const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kStays_s);
      while (client && !stop.stop_requested() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    });
  };
  // A client that is refused is not seen by the emulator; one that comes first makes the head wait.
  return {"lidar", "second client", begin, kStays_s, {}, AllPhases()};
}

}  // namespace

const std::vector<HeadFault>& HeadFaults() {
  static const std::vector<HeadFault> kFaults = [] {
    std::vector<HeadFault> faults = {
        OfLidar(
            "corrupt sums", [](auto& lidar) { lidar.InjectCorruptScans(5); }, 0.0),
        OfLidar("short stall", [](auto& lidar) { lidar.InjectStall(0.5); }, 0.5,
                {Phase::kDisconnected, Phase::kConnecting, Phase::kHoming, Phase::kReady,
                 Phase::kStopping, Phase::kFault}),  // over before a line is due
        OfLidar(
            "long stall", [](auto& lidar) { lidar.InjectStall(4.0); }, 4.0),
        OfLidar(
            "silence", [](auto& lidar) { lidar.InjectSilence(4.0); }, 4.0),
        OfLidar("reset", [](auto& lidar) { lidar.InjectReset(); }, 0.0,
                {Phase::kDisconnected, Phase::kConnecting}),  // no connection to break
        OfLidar(
            "abnormal state", [](auto& lidar) { lidar.InjectAbnormalState(); }, 0.0),
        OfLidar(
            "clock jumps ahead", [](auto& lidar) { lidar.InjectClockJump(3600.0); }, 0.0),
        OfLidar(
            "clock jumps back", [](auto& lidar) { lidar.InjectClockJump(-2.0); }, 0.0),
        OfLidar(
            "clock stands still", [](auto& lidar) { lidar.InjectStoppedClock(6.0); }, 6.0),
        OfLidar(
            "bad sums", [](auto& lidar) { lidar.InjectCorruptScans(200); }, 6.0),
        OfLidar(
            "missing beams", [](auto& lidar) { lidar.InjectMissingBeams(10, 200); }, 6.0),
        SecondClientOfTheLidar(),
    };
    for (int i = 0; i < MotorFault::kKinds; ++i)
      faults.push_back(OfMotor(static_cast<MotorFault::Kind>(i)));
    faults.push_back(OfCamera(
        "packet loss 5 %", [](auto& camera) { camera.InjectPacketLoss(0.05); }, 0.0));
    faults.push_back(OfCamera(
        "vanished", [](auto& camera) { camera.InjectVanish(4.0); }, 4.0));
    faults.push_back(OfCamera(
        "ignored trigger", [](auto& camera) { camera.InjectIgnoredTriggers(1); }, 0.0));
    faults.push_back(OfCamera(
        "slow image", [](auto& camera) { camera.InjectSlowFrames(1, 3.0); }, 3.0));
    return faults;
  }();
  return kFaults;
}

}  // namespace foresight
