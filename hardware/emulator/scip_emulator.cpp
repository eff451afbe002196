#include "hardware/emulator/scip_emulator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/contract.h"
#include "core/base/log.h"
#include "core/base/random.h"

namespace foresight {
namespace {

constexpr auto kScipSendTimeout = std::chrono::seconds(2);
constexpr auto kIdlePeriod = std::chrono::seconds(60);
/// A machine that cannot keep up loses scans, as a device does whose client is too slow.
constexpr double kTooLate_turns = 8.0;

/// Flips one bit of the scan's data; its echo and status stay as they are.
void Corrupt(std::string& bytes, std::uint64_t seed) {
  Random random(seed);
  const std::size_t data = bytes.find('\n', bytes.find('\n') + 1) + 1;
  std::size_t at = data;
  do {
    at = data + static_cast<std::size_t>(random.Index(static_cast<int>(bytes.size() - data - 2)));
  } while (bytes[at] == '\n');
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
}

}  // namespace

Result<std::unique_ptr<ScipEmulator>> ScipEmulator::Start(
    std::shared_ptr<const World> world, std::shared_ptr<SimulatedClock> clock,
    std::shared_ptr<const SimulatedShaft> shaft, const ScipEmulatorOptions& options) {
  FORESIGHT_EXPECTS(world && clock && shaft, "an emulated lidar lives in a world");
  FORESIGHT_EXPECTS(clock->speed() == SimulationSpeed::kRealTime, "sockets know no other time");
  FORESIGHT_CHECK(options.faults.Check());
  FORESIGHT_TRY(TcpListener listener, TcpListener::Listen(options.address));
  return std::unique_ptr<ScipEmulator>(new ScipEmulator(
      std::move(world), std::move(clock), std::move(shaft), options, std::move(listener)));
}

ScipEmulator::ScipEmulator(std::shared_ptr<const World> world,
                           std::shared_ptr<SimulatedClock> clock,
                           std::shared_ptr<const SimulatedShaft> shaft,
                           const ScipEmulatorOptions& options, TcpListener listener)
    : world_(std::move(world)),
      clock_(std::move(clock)),
      shaft_(std::move(shaft)),
      faults_(options.faults),
      listener_(std::move(listener)),
      address_(listener_.address()),
      device_(world_->true_rig().lidar, options.identity, options.faults, clock_->Now()) {
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

ScipEmulator::~ScipEmulator() {
  thread_.request_stop();
  wake_.Raise();
}

void ScipEmulator::InjectStall(double seconds) {
  const std::lock_guard lock(mutex_);
  injections_.stalled_until_s = clock_->Now() + seconds;
}

void ScipEmulator::InjectSilence(double seconds) {
  const std::lock_guard lock(mutex_);
  injections_.silent_until_s = clock_->Now() + seconds;
}

void ScipEmulator::InjectReset() {
  const std::lock_guard lock(mutex_);
  injections_.reset = true;
  wake_.Raise();
}

void ScipEmulator::InjectCorruptScans(int scans) {
  const std::lock_guard lock(mutex_);
  injections_.corrupt_scans += scans;
}

void ScipEmulator::InjectClockJump(double seconds) {
  const std::lock_guard lock(mutex_);
  injections_.clock_jump_s += seconds;
  wake_.Raise();
}

void ScipEmulator::InjectStoppedClock(double seconds) {
  const std::lock_guard lock(mutex_);
  injections_.clock_stops_until_s = clock_->Now() + seconds;
  wake_.Raise();
}

void ScipEmulator::InjectMissingBeams(int beams, int scans) {
  const std::lock_guard lock(mutex_);
  injections_.missing_beams = beams;
  injections_.short_scans = scans;
}

void ScipEmulator::InjectAbnormalState() {
  const std::lock_guard lock(mutex_);
  injections_.abnormal = true;
  wake_.Raise();
}

void ScipEmulator::ClearFaults() {
  const std::lock_guard lock(mutex_);
  injections_ = {};
  wake_.Raise();
}

ScipEmulator::Counts ScipEmulator::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

double ScipEmulator::TurnReady_s(std::int64_t turn) const {
  const LidarModel& lidar = world_->true_rig().lidar;
  return static_cast<double>(turn) * lidar.period_s + lidar.BeamTime(lidar.beams);
}

std::int64_t ScipEmulator::NextTurn() const {
  return static_cast<std::int64_t>(std::ceil(clock_->Now() / world_->true_rig().lidar.period_s));
}

std::int64_t ScipEmulator::LastTurn() const {
  return static_cast<std::int64_t>(
      std::floor((clock_->Now() - TurnReady_s(0)) / world_->true_rig().lidar.period_s));
}

LidarLine ScipEmulator::MeasureTurn(std::int64_t turn) const {
  return world_->MeasureLine(turn, static_cast<double>(turn) * world_->true_rig().lidar.period_s,
                             [this](double time_s) { return shaft_->At(time_s).angle_rad; });
}

void ScipEmulator::Work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Result<std::optional<TcpSocket>> client = listener_.Accept(kIdlePeriod, &wake_);
    wake_.Lower();
    if (!client) return LogError("emulated lidar {}", client.error().message);
    if (!*client) continue;
    listener_.Refuse();
    {
      const std::lock_guard lock(mutex_);
      ++counts_.clients;
      injections_.reset = false;  // meant for the client before
    }
    ServeClient(**client, stop);
    (*client)->Close();
    if (const Status resumed = listener_.Resume(); !resumed)
      return LogError("emulated lidar {}", resumed.error().message);
  }
}

void ScipEmulator::ServeClient(TcpSocket& client, const std::stop_token& stop) {
  device_.BeginConnection();
  reader_ = {};
  std::array<char, 4096> buffer;
  while (!stop.stop_requested()) {
    TcpSocket::Duration wait = kIdlePeriod;
    if (device_.Streaming())
      wait = std::chrono::duration_cast<TcpSocket::Duration>(
          std::chrono::duration<double>(TurnReady_s(next_turn_) - clock_->Now()));
    const Result<std::size_t> size = client.Receive(buffer, wait, &wake_);
    wake_.Lower();
    if (!size || !FollowInjections(client)) return;
    if (*size > 0 && !HandleRequest(client, {buffer.data(), *size})) return;
    if (device_.TakeReboot()) return EndReboot(client);
    if (device_.Streaming() && clock_->Now() >= TurnReady_s(next_turn_) && !SendDueLine(client))
      return;
  }
}

void ScipEmulator::EndReboot(TcpSocket& client) {
  client.Reset();
  const std::lock_guard lock(mutex_);
  ++counts_.reboots;
  injections_ = {};
}

/// Whether the connection stands.
bool ScipEmulator::FollowInjections(TcpSocket& client) {
  const std::lock_guard lock(mutex_);
  device_.ShiftClock(std::exchange(injections_.clock_jump_s, 0.0));
  const bool stops = clock_->Now() < injections_.clock_stops_until_s;
  if (stops && !clock_stopped_) device_.StopClock(clock_->Now());
  if (!stops && clock_stopped_) device_.ResumeClock();
  clock_stopped_ = stops;
  if (std::exchange(injections_.abnormal, false)) {
    device_.BeginConnection();  // ends the stream
    device_.EnterAbnormalState();
    ++counts_.fault_effects;
  }
  if (!std::exchange(injections_.reset, false)) return true;
  ++counts_.fault_effects;
  client.Reset();
  return false;
}

Status ScipEmulator::HandleRequest(TcpSocket& client, std::string_view bytes) {
  reader_.Push(bytes);
  while (const auto request = reader_.Take()) {
    const double now_s = clock_->Now();
    {
      const std::lock_guard lock(mutex_);
      if (now_s < injections_.silent_until_s) {
        ++counts_.fault_effects;
        continue;
      }
    }
    if (device_.Hindered(now_s)) CountEffect();
    const bool streaming = device_.Streaming();
    const std::string reply =
        device_.Answer(*request, now_s, [this] { return MeasureTurn(LastTurn()); });
    if (device_.Streaming() && !streaming) next_turn_ = NextTurn();
    if (reply.empty()) CountEffect();
    FORESIGHT_CHECK(Send(client, reply));
  }
  return {};
}

void ScipEmulator::CountEffect() {
  const std::lock_guard lock(mutex_);
  ++counts_.fault_effects;
}

/// The faults that the plan holds for a turn become injections.
void ScipEmulator::ApplyFaultsOfTurn(std::int64_t turn) {
  Random random(faults_.seed, static_cast<std::uint64_t>(turn));
  const bool corrupt = random.Uniform() < faults_.corrupt_fraction;
  const bool reset = random.Uniform() < faults_.reset_fraction;
  const bool stall = random.Uniform() < faults_.stall_fraction;
  if (corrupt) InjectCorruptScans(1);
  if (reset) InjectReset();
  if (stall) InjectStall(faults_.stall_s);
}

Status ScipEmulator::SendDueLine(TcpSocket& client) {
  const std::int64_t turn = next_turn_;
  next_turn_ += device_.TurnsPerScan();
  ApplyFaultsOfTurn(turn);
  if (!FollowInjections(client))
    return Fail(ErrorCode::kDevice, "{}: was reset", client.peer().ToText());
  if (!device_.Streaming()) return {};
  const double now_s = clock_->Now();
  bool corrupt = false;
  {
    const std::lock_guard lock(mutex_);
    const double late_s = now_s - TurnReady_s(turn);
    if (late_s > kTooLate_turns * world_->true_rig().lidar.period_s) {
      ++counts_.skipped;
      return {};
    }
    if (now_s < std::max(injections_.stalled_until_s, injections_.silent_until_s)) {
      ++counts_.fault_effects;
      return {};
    }
    ++counts_.scans;
    const bool lacks_beams = injections_.short_scans > 0;
    if (lacks_beams) --injections_.short_scans;
    device_.LoseBeams(lacks_beams ? injections_.missing_beams : faults_.missing_beams);
    const bool wrong_stamp = device_.ClockAt(now_s) != device_.HealthyClockAt(now_s);
    if (lacks_beams || faults_.missing_beams > 0 || wrong_stamp) ++counts_.fault_effects;
    if (injections_.corrupt_scans > 0) {
      --injections_.corrupt_scans;
      ++counts_.corrupted;
      ++counts_.fault_effects;
      corrupt = true;
    }
  }
  std::string bytes = device_.StreamScan(MeasureTurn(turn));
  if (corrupt) Corrupt(bytes, static_cast<std::uint64_t>(turn));
  return Send(client, bytes);
}

Status ScipEmulator::Send(TcpSocket& client, std::string_view bytes) {
  const auto piece = faults_.fragment_bytes > 0 ? static_cast<std::size_t>(faults_.fragment_bytes)
                                                : std::max<std::size_t>(1, bytes.size());
  if (piece < bytes.size()) CountEffect();
  for (std::size_t at = 0; at < bytes.size(); at += piece)
    FORESIGHT_CHECK(client.Send(bytes.substr(at, piece), kScipSendTimeout));
  return {};
}

}  // namespace foresight
