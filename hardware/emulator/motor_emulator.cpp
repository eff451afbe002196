#include "hardware/emulator/motor_emulator.h"

#include <algorithm>
#include <chrono>

#include "core/base/contract.h"
#include "core/base/log.h"

namespace foresight {
namespace {

using cia402::RxImage;
using cia402::TxImage;

/// Between two looks at a drive of which nothing is asked.
constexpr std::chrono::milliseconds kRest{20};

/// Whether registers `first` to `first + count - 1` lie in an image.
template <class Image>
bool Holds(std::uint16_t first, std::size_t count) {
  return first >= Image::kFirst && first - Image::kFirst + count <= Image::kCount;
}

template <class Registers>
std::vector<std::uint16_t> Part(const Registers& registers, std::size_t offset, std::size_t count) {
  const auto begin = registers.begin() + static_cast<std::ptrdiff_t>(offset);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

Result<std::unique_ptr<MotorEmulator>> MotorEmulator::Start(std::shared_ptr<const World> world,
                                                            std::shared_ptr<SimulatedClock> clock,
                                                            std::shared_ptr<SimulatedShaft> shaft,
                                                            const MotorEmulatorOptions& options) {
  FORESIGHT_EXPECTS(clock->speed() == SimulationSpeed::kRealTime, "a wire has the wall's time");
  std::unique_ptr<MotorEmulator> emulator(
      new MotorEmulator(std::move(world), std::move(clock), std::move(shaft), options));
  FORESIGHT_TRY(emulator->server_, ModbusServer::Start(options.address, *emulator));
  emulator->thread_ =
      std::jthread([self = emulator.get()](const std::stop_token& stop) { self->Work(stop); });
  return emulator;
}

MotorEmulator::MotorEmulator(std::shared_ptr<const World> world,
                             std::shared_ptr<SimulatedClock> clock,
                             std::shared_ptr<SimulatedShaft> shaft,
                             const MotorEmulatorOptions& options)
    : clock_(std::move(clock)),
      shaft_(std::move(shaft)),
      options_(options),
      started_s_(clock_->Now()),
      drive_(std::move(world), shaft_, options.drive, started_s_),
      planned_(options.faults) {
  std::sort(planned_.begin(), planned_.end(),
            [](const auto& a, const auto& b) { return a.after_s > b.after_s; });
}

MotorEmulator::~MotorEmulator() {
  thread_ = std::jthread();  // asks it to stop and waits; it uses the server
  server_.reset();
  shaft_->Stop(clock_->Now(), options_.drive.quick_stop_rad_s2);
}

void MotorEmulator::Wake() {
  awake_ = true;
  wake_.notify_all();
}

void MotorEmulator::Work(const std::stop_token& stop) {
  double wake_s = clock_->Now();
  while (!stop.stop_requested()) {
    wake_s = std::max(wake_s + EmulatedDrive::kCycle_s, clock_->Now());
    clock_->WaitUntil(wake_s);
    std::unique_lock lock(mutex_);
    const double now_s = clock_->Now();
    RunFaults(now_s);
    drive_.Run(now_s);
    CountEffects(now_s);
    // At rest the cycles are run later, all at once; what arrives ends the rest.
    if (!running_.empty() || drive_.axis().Demanding(now_s)) continue;
    awake_ = false;
    wake_.wait_for(lock, stop, kRest, [this] { return awake_; });
  }
}

bool MotorEmulator::Runs(MotorFault::Kind kind) const {
  return std::any_of(running_.begin(), running_.end(),
                     [kind](const Running& fault) { return fault.kind == kind; });
}

/// Of faults that act while they last.
void MotorEmulator::CountEffects(double time_s) {
  const bool held = Runs(MotorFault::Kind::kBlockedShaft) && drive_.axis().Demanding(time_s);
  const bool hidden = drive_.home_switch().hidden();
  fault_effects_ += (held ? 1 : 0) + (hidden ? 1 : 0) + (drive_.StatusIsStale() ? 1 : 0);
}

int MotorEmulator::fault_effects() const {
  const std::lock_guard lock(mutex_);
  return fault_effects_ + server_->lost_requests();
}

std::optional<std::vector<std::uint16_t>> MotorEmulator::Read(ClientId client, std::uint16_t first,
                                                              std::uint16_t count) {
  const std::lock_guard lock(mutex_);
  const double now_s = clock_->Now();
  drive_.Run(now_s);
  if (client == commander_) drive_.FeedWatchdog(now_s);
  if (Holds<TxImage>(first, count) && Runs(MotorFault::Kind::kEncoderOffset)) ++fault_effects_;
  if (Holds<TxImage>(first, count))
    return Part(drive_.Image(now_s).Encode(options_.drive.word_order), first - TxImage::kFirst,
                count);
  if (Holds<RxImage>(first, count))
    return Part(drive_.written().Encode(options_.drive.word_order), first - RxImage::kFirst, count);
  return std::nullopt;
}

bool MotorEmulator::Write(ClientId client, std::uint16_t first,
                          std::span<const std::uint16_t> values) {
  if (!Holds<RxImage>(first, values.size())) return false;
  const std::lock_guard lock(mutex_);
  const double now_s = clock_->Now();
  drive_.Run(now_s);
  RxImage::Registers registers = drive_.written().Encode(options_.drive.word_order);
  std::copy(values.begin(), values.end(), registers.begin() + (first - RxImage::kFirst));
  commander_ = client;
  drive_.Write(now_s, RxImage::Decode(registers, options_.drive.word_order));
  Wake();
  return true;
}

double MotorEmulator::zero_rad() const {
  const std::lock_guard lock(mutex_);
  return drive_.zero_rad();
}

TxImage MotorEmulator::State() const {
  const std::lock_guard lock(mutex_);
  return drive_.Image(clock_->Now());
}

void MotorEmulator::Inject(const MotorFault& fault) {
  const std::lock_guard lock(mutex_);
  const double now_s = clock_->Now();
  drive_.Run(now_s);
  Begin(fault, now_s);
  Wake();
}

void MotorEmulator::ClearFaults() {
  const std::lock_guard lock(mutex_);
  const double now_s = clock_->Now();
  drive_.Run(now_s);
  for (const Running& running : running_) End(running.kind, now_s);
  running_.clear();
}

void MotorEmulator::RunFaults(double time_s) {
  while (!planned_.empty() && time_s - started_s_ >= planned_.back().after_s) {
    Begin(planned_.back(), time_s);
    planned_.pop_back();
  }
  const auto over = std::partition(running_.begin(), running_.end(),
                                   [&](const Running& fault) { return fault.end_s > time_s; });
  for (auto fault = over; fault != running_.end(); ++fault) End(fault->kind, time_s);
  running_.erase(over, running_.end());
}

void MotorEmulator::Begin(const MotorFault& fault, double time_s) {
  LogInfo("motor emulator {}: {} for {:.1f} s", address().ToText(), ToString(fault.kind),
          fault.duration_s);
  const double end_s = time_s + fault.duration_s;
  running_.push_back({fault.kind, end_s});
  switch (fault.kind) {
    case MotorFault::Kind::kBlockedShaft:
      return drive_.axis().Block(time_s);
    case MotorFault::Kind::kLostHomeSwitch:
      return drive_.home_switch().Break();
    case MotorFault::Kind::kDeadLink:
      return server_->SetSilent(true);
    case MotorFault::Kind::kStaleStatus:
      return drive_.HoldStatusUntil(end_s);
    case MotorFault::Kind::kTcpReset:
      fault_effects_ += server_->ResetConnections();
      return;
    case MotorFault::Kind::kEncoderOffset:
      return drive_.SetEncoderOffset(MotorFault::kEncoderOffset_rad);
  }
}

void MotorEmulator::End(MotorFault::Kind kind, double time_s) {
  switch (kind) {
    case MotorFault::Kind::kBlockedShaft:
      return drive_.axis().Release(time_s);
    case MotorFault::Kind::kLostHomeSwitch:
      return drive_.home_switch().Repair();
    case MotorFault::Kind::kDeadLink:
      return server_->SetSilent(false);
    case MotorFault::Kind::kStaleStatus:
      return drive_.HoldStatusUntil(time_s);
    case MotorFault::Kind::kTcpReset:
      return;
    case MotorFault::Kind::kEncoderOffset:
      return drive_.SetEncoderOffset(0.0);
  }
}

}  // namespace foresight
