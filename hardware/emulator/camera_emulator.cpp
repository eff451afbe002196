#include "hardware/emulator/camera_emulator.h"

#include <algorithm>
#include <array>

#include "core/base/contract.h"
#include "core/base/log.h"
#include "core/base/random.h"

namespace foresight {
namespace {

constexpr double kIdlePeriod_s = 0.1;
constexpr std::size_t kIpAndUdpBytes = 28;
/// A gigabit link. Packets are sent in bursts, because nobody sleeps for 11 us.
constexpr double kLinkBytes_s = 125e6;
constexpr std::uint32_t kBurst = 16;
constexpr std::uint64_t kIgnoredStream = 1;
constexpr std::uint64_t kSlowStream = 2;

/// Whether the plan's fault meets the `number`th of something.
bool Affects(std::uint64_t seed, std::uint64_t stream, std::int64_t number, double fraction) {
  return fraction > 0.0 &&
         Random(seed ^ (stream << 56U), static_cast<std::uint64_t>(number)).Uniform() < fraction;
}

}  // namespace

Result<std::unique_ptr<CameraEmulator>> CameraEmulator::Start(
    std::shared_ptr<const World> world, std::shared_ptr<SimulatedClock> clock,
    std::shared_ptr<const SimulatedShaft> shaft, const CameraEmulatorOptions& options) {
  FORESIGHT_EXPECTS(world && clock && shaft, "an emulated camera lives in a world");
  FORESIGHT_EXPECTS(clock->speed() == SimulationSpeed::kRealTime, "sockets know no other time");
  FORESIGHT_CHECK(options.faults.Check());
  FORESIGHT_TRY(UdpSocket control, UdpSocket::Bind({options.address, gvcp::kPort}));
  FORESIGHT_TRY(UdpSocket stream, UdpSocket::Bind({options.address, 0}));
  return std::unique_ptr<CameraEmulator>(new CameraEmulator(std::move(world), std::move(clock),
                                                            std::move(shaft), options,
                                                            std::move(control), std::move(stream)));
}

CameraEmulator::CameraEmulator(std::shared_ptr<const World> world,
                               std::shared_ptr<SimulatedClock> clock,
                               std::shared_ptr<const SimulatedShaft> shaft,
                               const CameraEmulatorOptions& options, UdpSocket control,
                               UdpSocket stream)
    : world_(std::move(world)),
      clock_(std::move(clock)),
      shaft_(std::move(shaft)),
      faults_(options.faults),
      power_on_s_(clock_->Now()),
      control_(std::move(control)),
      stream_(std::move(stream)),
      device_(world_->true_rig().camera.width, world_->true_rig().camera.height, options.identity,
              control_.ip(), options.faults, power_on_s_),
      next_block_(options.faults.first_block) {
  injections_.loss_ratio = faults_.packet_loss_ratio;
  renderer_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
  server_ = std::jthread([this](const std::stop_token& stop) { Serve(stop); });
}

CameraEmulator::~CameraEmulator() {
  renderer_.request_stop();
  server_.request_stop();
  wake_.Raise();
}

void CameraEmulator::InjectPacketLoss(double fraction) {
  const std::lock_guard lock(mutex_);
  injections_.loss_ratio = fraction;
}

void CameraEmulator::InjectVanish(double seconds) {
  const std::lock_guard lock(mutex_);
  injections_.gone_until_s = clock_->Now() + seconds;
}

void CameraEmulator::InjectIgnoredTriggers(int triggers) {
  const std::lock_guard lock(mutex_);
  injections_.ignored_triggers += triggers;
}

void CameraEmulator::InjectSlowFrames(int frames, double seconds) {
  const std::lock_guard lock(mutex_);
  injections_.slow_frames += frames;
  injections_.slow_s = seconds;
}

void CameraEmulator::ClearFaults() {
  const std::lock_guard lock(mutex_);
  injections_ = {};
  injections_.loss_ratio = faults_.packet_loss_ratio;
}

std::vector<CameraEmulator::Taken> CameraEmulator::taken() const {
  const std::lock_guard lock(mutex_);
  return taken_;
}

CameraEmulator::Counts CameraEmulator::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

bool CameraEmulator::GoneAt(double time_s) const {
  const double age_s = time_s - power_on_s_;
  if (age_s >= faults_.vanish_after_s && age_s < faults_.vanish_after_s + faults_.vanish_s)
    return true;
  const std::lock_guard lock(mutex_);
  return time_s < injections_.gone_until_s;
}

bool CameraEmulator::LosesAt(double time_s) {
  if (!GoneAt(time_s)) return false;
  const std::lock_guard lock(mutex_);
  ++counts_.fault_effects;
  return true;
}

bool CameraEmulator::Current(int acquisition) const {
  const std::lock_guard lock(mutex_);
  return acquisition == acquisition_;
}

void CameraEmulator::Serve(const std::stop_token& stop) {
  std::array<std::uint8_t, 2048> buffer;
  while (!stop.stop_requested()) {
    const auto period_s = device_.FreeRunPeriod();
    const double wait_s =
        period_s ? std::clamp(next_free_run_s_ - clock_->Now(), 0.0, kIdlePeriod_s) : kIdlePeriod_s;
    const auto datagram =
        control_.Receive(buffer, std::chrono::microseconds(static_cast<int>(1e6 * wait_s)), &wake_);
    if (stop.stop_requested()) return;
    const double now_s = clock_->Now();
    if (datagram && !LosesAt(now_s))
      HandleRequest(std::span(buffer).first(datagram->size), datagram->from);
    device_.PassTime(now_s);
    FinishAcquisition();
    if (period_s && device_.FreeRunPeriod() && now_s >= next_free_run_s_) {
      next_free_run_s_ = std::max(next_free_run_s_ + *period_s, now_s);
      Trigger(now_s);
    }
  }
}

void CameraEmulator::HandleRequest(std::span<const std::uint8_t> packet, const UdpPeer& from) {
  const std::vector<std::uint8_t> answer = device_.Answer(packet, from, clock_->Now());
  ApplyCommands();
  if (answer.empty()) return;
  if (const Status sent = control_.SendTo(answer, from); !sent)
    LogError("emulated camera {}", sent.error().message);
}

/// Images of an acquisition that is over are not sent.
void CameraEmulator::FinishAcquisition() {
  const std::lock_guard lock(mutex_);
  if (acquisition_ == device_.acquisition()) return;
  acquisition_ = device_.acquisition();
  jobs_.clear();
}

void CameraEmulator::ApplyCommands() {
  FinishAcquisition();
  const CameraDevice::Commands commands = device_.TakeCommands();
  for (int i = 0; i < commands.triggers; ++i) Trigger(clock_->Now());
  for (const gvcp::PacketResend& resend : commands.resends) Resend(resend);
  if (commands.test_packet) SendTestPacket();
}

void CameraEmulator::Trigger(double now_s) {
  Job job{device_.Expose(now_s), next_seq_++, device_.TicksAt(now_s), device_.acquisition(), 0.0};
  const bool ignored =
      Affects(faults_.seed, kIgnoredStream, job.seq, faults_.ignored_trigger_fraction);
  if (Affects(faults_.seed, kSlowStream, job.seq, faults_.slow_frame_fraction))
    job.late_s = faults_.slow_s;
  const std::lock_guard lock(mutex_);
  if (ignored || injections_.ignored_triggers > 0) {
    if (!ignored) --injections_.ignored_triggers;
    ++counts_.ignored_triggers;
    ++counts_.fault_effects;
    return;
  }
  if (injections_.slow_frames > 0) {
    --injections_.slow_frames;
    job.late_s = injections_.slow_s;
  }
  const bool wrong_stamp = faults_.clock_ppm != 0.0 || faults_.clock_start_s != 0.0;
  if (job.late_s > 0.0 || wrong_stamp) ++counts_.fault_effects;
  taken_.push_back({job.seq, now_s + 0.5 * job.exposure.exposure_s, job.exposure.exposure_s,
                    job.exposure.gain_db, job.exposure.format});
  jobs_.push_back(job);
  work_.notify_all();
}

void CameraEmulator::Resend(const gvcp::PacketResend& resend) {
  const auto frame = ring_.Find(resend.block);
  if (!frame || resend.first > resend.last) return;
  const UdpPeer to = device_.Expose(0.0).stream.to;
  const std::uint32_t last = std::min(resend.last, frame->PacketCount() - 1);
  ++resend_rounds_;
  for (std::uint32_t number = resend.first; number <= last; ++number)
    SendPacket(*frame, number, to, resend_rounds_);
}

/// Its size is what matters: a client looks how large packets may be on their way to it.
void CameraEmulator::SendTestPacket() {
  const CameraStreamSetup setup = device_.Expose(0.0).stream;
  if (setup.to.port == 0) return;
  const std::vector<std::uint8_t> packet(setup.packet_bytes - kIpAndUdpBytes);
  if (const Status sent = stream_.SendTo(packet, setup.to); !sent)
    LogWarning("emulated camera {}", sent.error().message);
}

void CameraEmulator::Work(const std::stop_token& stop) {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      if (!work_.wait(lock, stop, [this] { return !jobs_.empty(); })) return;
      job = jobs_.front();
      jobs_.pop_front();
    }
    try {
      Deliver(job, stop);
    } catch (const std::exception& error) {
      LogError("emulated camera {}: {}", address(), error.what());
    }
  }
}

void CameraEmulator::Deliver(const Job& job, const std::stop_token& stop) {
  RunContext context;
  context.stop = stop;
  const CameraExposure& exposure = job.exposure;
  const double end_s = exposure.start_s + exposure.exposure_s;
  clock_->WaitUntil(end_s + kReadout_s + job.late_s);
  const CameraFrame capture = world_->CaptureImage(
      job.seq, exposure.start_s + 0.5 * exposure.exposure_s, exposure.exposure_s, exposure.gain_db,
      [this](double time_s) { return shaft_->At(time_s).angle_rad; }, context);
  if (stop.stop_requested() || !Current(job.acquisition) || exposure.stream.to.port == 0) return;
  if (block_acquisition_ != job.acquisition) {
    block_acquisition_ = job.acquisition;
    next_block_ = faults_.first_block;
    ring_.Clear();
  }
  auto frame = std::make_shared<GvspFrame>();
  frame->block = next_block_;
  next_block_ = static_cast<std::uint16_t>(next_block_ == 0xFFFF ? 1 : next_block_ + 1);
  frame->leader = {job.timestamp, exposure.format,
                   static_cast<std::uint32_t>(capture.image.width()),
                   static_cast<std::uint32_t>(capture.image.height())};
  frame->pixels = EncodePixels(capture.image, exposure.format);
  frame->payload_bytes = exposure.stream.packet_bytes - gvsp::kOverheadBytes;
  ring_.Add(frame);
  SendFrame(*frame, exposure.stream, stop);
  const std::lock_guard lock(mutex_);
  ++counts_.frames;
  if (faults_.first_block != 1) ++counts_.fault_effects;
}

void CameraEmulator::SendFrame(const GvspFrame& frame, const CameraStreamSetup& setup,
                               const std::stop_token& stop) {
  const double burst_s =
      kBurst * (static_cast<double>(setup.packet_bytes) / kLinkBytes_s + setup.packet_delay_s);
  double next_burst_s = clock_->Now();
  const std::uint32_t count = frame.PacketCount();
  for (std::uint32_t number = 0; number < count && !stop.stop_requested(); ++number) {
    if (number % kBurst == 0) {
      clock_->WaitUntil(next_burst_s);
      // Who came late does not hurry: a link has its rate.
      next_burst_s = clock_->Now() + burst_s;
    }
    SendPacket(frame, number, setup.to, 0);
  }
}

void CameraEmulator::SendPacket(const GvspFrame& frame, std::uint32_t number, const UdpPeer& to,
                                std::int64_t round) {
  if (LosesAt(clock_->Now())) return;
  {
    const std::lock_guard lock(mutex_);
    ++counts_.packets;
    if (round > 0) ++counts_.resent_packets;
    const auto which = static_cast<std::uint64_t>(round) << 40U |
                       static_cast<std::uint64_t>(frame.block) << 24U | number;
    if (Random(faults_.seed, which).Uniform() < injections_.loss_ratio) {
      ++counts_.lost_packets;
      ++counts_.fault_effects;
      return;
    }
  }
  if (const Status sent = stream_.SendTo(frame.Packet(number), to); !sent)
    LogWarning("emulated camera {}", sent.error().message);
}

}  // namespace foresight
