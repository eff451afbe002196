#include "hardware/link/client/remote_head.h"

#include <future>

#include "core/base/contract.h"
#include "core/base/log.h"
#include "core/base/utc_text.h"
#include "core/mission/plan_json.h"
#include "core/sensor/rig_id.h"
#include "hardware/link/client/fit_client.h"
#include "hardware/link/client/image_client.h"
#include "hardware/link/client/pose_sender.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kRigTimeout{
    15'000};  ///< 3 kB at 9600 bit/s, and a blackout's end

constexpr std::chrono::milliseconds kControlTimeout{4000};

}  // namespace

RemoteHead::RemoteHead(std::vector<ChannelMaker> channels, const Options& options)
    : options_(options),
      session_(std::move(channels), options.address, !options.looks_on),
      mirror_(options.address) {}

Result<std::shared_ptr<RemoteHead>> RemoteHead::Connect(std::vector<ChannelMaker> channels,
                                                        const Options& options,
                                                        std::chrono::milliseconds timeout) {
  auto head = std::shared_ptr<RemoteHead>(new RemoteHead(std::move(channels), options));
  if (options.burst) {
    FORESIGHT_TRY(head->burst_, BurstClient::Listen(*options.burst));
  }
  const double end_s = LinkSession::Now() + 1e-3 * static_cast<double>(timeout.count());
  for (;;) {
    foresight::Status begun = head->session_.Begin(timeout);
    if (begun) begun = head->FetchRig();
    if (begun) break;
    if (begun.error().code == ErrorCode::kState || LinkSession::Now() > end_s)
      return tl::unexpected(begun.error());
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
  }
  FORESIGHT_TRY(head->motion_, FromMessage(head->session_.HeadIdentity().motion()));
  ScanFetcher::Options fetching;
  fetching.spool = options.spool;
  fetching.archive = options.archive;
  RemoteHead* raw = head.get();
  fetching.rig_yaml = [raw] {
    const std::lock_guard lock(raw->mutex_);
    return raw->rig_yaml_;
  };
  fetching.burst = head->burst_.get();
  fetching.thin = options.thin;
  fetching.round_trip = [raw] { return raw->session_.RoundTrip(); };
  head->stopper_ = std::make_unique<StopSender>(head->session_, [raw](const link::Outcome& o) {
    static_cast<void>(raw->mirror_.Take(o.status(), o.desk_time_s()));
  });
  head->commands_ = std::make_unique<CommandSender>(head->session_, options.command_good_s);
  FORESIGHT_CHECK(head->FetchStand());
  WatchClient::Hooks hooks;
  hooks.on_begin = [raw] { raw->OnBegin(); };
  hooks.on_event = [raw](const link::Event& event) { raw->OnEvent(event); };
  hooks.on_lost = [raw](const Error& error) { raw->mirror_.Lost(error); };
  head->fetcher_ = std::make_unique<ScanFetcher>(head->session_, std::move(fetching));
  head->watch_ =
      std::make_unique<WatchClient>(head->session_, options.status_rate_hz, std::move(hooks));
  while (!head->mirror_.Connected() && LinkSession::Now() < end_s)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  if (!head->mirror_.Connected())
    return Fail(ErrorCode::kDevice, "{}: the head said who it is and then nothing more",
                options.address);
  return head;
}

/// In the opposite order of their making: the watch uses all others, and none of them the watch.
RemoteHead::~RemoteHead() {
  watch_.reset();
  if (stand_) stand_->Leave();
  commands_.reset();
  stopper_.reset();
  look_.reset();
  stops_.reset();
  fetcher_.reset();
}

Status RemoteHead::FetchRig() {
  link::RigReply reply;
  const auto context = LinkSession::Context(kRigTimeout);
  const grpc::Status called =
      session_.stub(*context)->GetRig(context.get(), link::RigRequest(), &reply);
  if (!called.ok()) return tl::unexpected(session_.ToError(called, "its calibration"));
  FORESIGHT_TRY(SensorRig rig, SensorRigFromYaml(reply.yaml(), options_.address));
  const std::lock_guard lock(mutex_);
  rig_ = std::move(rig);
  rig_yaml_ = reply.yaml();
  rig_id_ = RigId(rig_);
  return {};
}

/// Of a real head nobody believes that its stand moves by itself.
Status RemoteHead::FetchStand() {
  const link::IdentifyReply identity = session_.HeadIdentity();
  if (!identity.simulated() || !identity.has_stand()) return {};
  link::StandReply reply;
  const auto context = LinkSession::Context(kRigTimeout);
  const grpc::Status called =
      session_.stub(*context)->GetStand(context.get(), link::StandRequest(), &reply);
  if (!called.ok()) return tl::unexpected(session_.ToError(called, "its stand"));
  FORESIGHT_TRY(StandDescription stand, FromMessage(reply));
  stand_ = std::make_shared<RemoteStand>(std::move(stand),
                                         [this](link::Command command, CommandSender::Done done) {
                                           commands_->Send(std::move(command), std::move(done));
                                         });
  return {};
}

/// The link is there, perhaps after a long time: what changed meanwhile is asked for.
void RemoteHead::OnBegin() {
  const std::string boot_id = session_.HeadIdentity().boot_id();
  {
    const std::lock_guard lock(mutex_);
    if (boot_id != boot_id_) mirror_.Forget();
    if (stand_ && boot_id != boot_id_) stand_->Forget();
    boot_id_ = boot_id;
  }
  link::ListScansReply scans;
  const auto context = LinkSession::Context(kRigTimeout);
  const grpc::Status called =
      session_.stub(*context)->ListScans(context.get(), link::ListScansRequest(), &scans);
  if (called.ok()) fetcher_->Heard({scans.scans().begin(), scans.scans().end()}, true);
}

void RemoteHead::OnEvent(const link::Event& event) {
  if (const foresight::Status taken = mirror_.Take(event.status(), event.desk_time_s()); !taken)
    LogError("{}: {}", options_.address, taken.error().message);
  if (stand_) stand_->Heard(event.status().stand_at(), event.desk_time_s());
  if (event.scans_size() > 0) fetcher_->Heard({event.scans().begin(), event.scans().end()}, false);
  std::string known;
  {
    const std::lock_guard lock(mutex_);
    known = rig_id_;
  }
  if (!event.status().rig_id().empty() && event.status().rig_id() != known)
    if (const foresight::Status fetched = FetchRig(); !fetched)
      LogError("{}", fetched.error().message);
  session_.HeardControl(event.operator_name(), event.desk_time_s());
  // A lease that ran out in a blackout: nobody has control, so it is ours again.
  if (event.operator_name().empty() && MayOperate() && session_.WantsControl())
    static_cast<void>(session_.TakeControl(std::chrono::milliseconds(2000)));
}

std::string RemoteHead::Describe() const {
  return fmt::format("{} at {}", session_.HeadIdentity().description(), options_.address);
}

HeadStatus RemoteHead::Status() const {
  return mirror_.Now();
}

SensorRig RemoteHead::Rig() const {
  const std::lock_guard lock(mutex_);
  return rig_;
}

HeadMotion RemoteHead::Motion() const {
  const std::lock_guard lock(mutex_);
  return motion_;
}

LinkHealth RemoteHead::Health() const {
  LinkHealth health;
  health.connected = mirror_.Connected();
  health.age_s = mirror_.Age();
  health.round_trip_s = session_.RoundTrip();
  health.down_bytes_per_s = fetcher_->DownBytesPerS();
  for (const LinkedScan& scan : fetcher_->Scans())
    if (scan.place == LinkedScan::Place::kComing || scan.place == LinkedScan::Place::kWaiting)
      health.left_bytes += scan.left_bytes;
  health.left_s = health.left_bytes == 0
                      ? 0.0
                      : static_cast<double>(health.left_bytes) / health.down_bytes_per_s;
  if (burst_) {
    const BurstCounts counts = burst_->Counts();
    health.burst = {true, counts.bytes, counts.Refused(), burst_->Trouble()};
  }
  health.stop = stopper_->Answer();
  {
    const std::lock_guard lock(mutex_);
    health.end_scan = end_scan_;
    health.end_scan_refusal = end_scan_refusal_;
  }
  health.has_control = !session_.Token().empty();
  health.holder = session_.Holder();
  health.address = options_.address;
  if (!health.connected) health.trouble = mirror_.Trouble();
  return health;
}

Status RemoteHead::TakeControl() {
  if (!MayOperate())
    return Fail(ErrorCode::kState, "{}: this certificate is an observer's: use an operator's",
                options_.address);
  FORESIGHT_CHECK(session_.TakeControl(kControlTimeout));
  if (session_.Token().empty())
    return Fail(ErrorCode::kState,
                "{}: {} has control: ask for it, or wait until they were silent for a minute",
                options_.address, session_.Holder());
  return {};
}

Status RemoteHead::GiveControl(const std::string& successor) {
  return session_.GiveControl(successor, kControlTimeout);
}

Result<RobotAnswer> RemoteHead::SendPose(const std::string& pose_json) {
  return foresight::SendPose(session_, pose_json);
}

Result<HeadFit> RemoteHead::Fit(const HeadFitOrder& order, const RunContext& context) {
  return FitOnHead(session_, order, context);
}

Result<HeadImage> RemoteHead::FetchImage(const HeadImageOrder& order) {
  return FetchHeadImage(session_, order);
}

Status RemoteHead::MayAct(const char* what) const {
  if (!mirror_.Connected())
    return Fail(ErrorCode::kState, "{}: cannot {}: no word from the head for {:.0f} s",
                options_.address, what, mirror_.Age());
  if (!session_.HeadIdentity().may_operate())
    return Fail(ErrorCode::kState, "{}: cannot {}: this certificate is an observer's",
                options_.address, what);
  if (session_.Token().empty())
    return Fail(ErrorCode::kState, "{}: cannot {}: {} has control", options_.address, what,
                session_.Holder());
  return {};
}

Status RemoteHead::SetRig(const SensorRig& rig) {
  FORESIGHT_CHECK(rig.Check());
  FORESIGHT_CHECK(MayAct("take another calibration"));
  link::Command command;
  command.mutable_set_rig()->set_yaml(SensorRigToYaml(rig));
  auto answered = std::make_shared<std::promise<CommandEnd>>();
  auto answer = answered->get_future();
  commands_->Send(std::move(command),
                  [answered](const CommandEnd& end) { answered->set_value(end); });
  const CommandEnd end = answer.get();
  if (end.kind != CommandEnd::Kind::kDone) return tl::unexpected(end.error);
  return FetchRig();
}

Status RemoteHead::Home() {
  FORESIGHT_CHECK(MayAct("be homed"));
  const HeadState state = Status().state;
  if (state != HeadState::kDisconnected && state != HeadState::kReady && state != HeadState::kFault)
    return Fail(ErrorCode::kState, "{}: cannot be homed while {}", options_.address,
                ToString(state));
  link::Command command;
  command.mutable_home();
  mirror_.Ask(HeadState::kHoming, "asking the head to search its zero reference");
  commands_->Send(std::move(command), [this](const CommandEnd& end) {
    if (end.outcome.has_status())
      static_cast<void>(mirror_.Take(end.outcome.status(), end.outcome.desk_time_s()));
    mirror_.Answered();
    if (end.kind != CommandEnd::Kind::kDone) mirror_.Tell("not homed: " + end.error.message);
  });
  return {};
}

Status RemoteHead::StartScan(const ScanPlan& plan, std::shared_ptr<ScanSink> sink) {
  FORESIGHT_EXPECTS(sink != nullptr, "a scan needs somewhere to go");
  FORESIGHT_CHECK(PredictScan(plan, Rig(), Motion()));
  FORESIGHT_CHECK(MayAct("scan"));
  const HeadState state = Status().state;
  if (state != HeadState::kReady)
    return Fail(ErrorCode::kState, "{}: cannot scan while {}{}", options_.address, ToString(state),
                state == HeadState::kDisconnected ? ": home it first" : "");
  Scan header;
  header.uuid = NewUuid();
  header.start_utc_ns = NowUtc_ns();
  header.source = Describe();
  header.simulated = Simulated();
  header.plan = plan;
  header.rig = Rig();
  link::Command command;
  command.mutable_start_scan()->set_scan_id(header.uuid);
  command.mutable_start_scan()->set_plan_json(PlanToJson(plan));
  fetcher_->Expect(header, std::move(sink));
  mirror_.Ask(HeadState::kSweeping, "asking the head to scan");
  commands_->Send(std::move(command), [this, id = header.uuid](const CommandEnd& end) {
    switch (end.kind) {
      case CommandEnd::Kind::kDone:
        fetcher_->Started(id);
        break;
      case CommandEnd::Kind::kRefused:
        fetcher_->Refuse(id, end.error.message);
        break;
      case CommandEnd::Kind::kUnknown:
        fetcher_->Doubt(id);
        break;
    }
    if (end.outcome.has_status())
      static_cast<void>(mirror_.Take(end.outcome.status(), end.outcome.desk_time_s()));
    mirror_.Answered();
    if (end.kind == CommandEnd::Kind::kRefused) mirror_.Tell("no scan: " + end.error.message);
    if (end.kind == CommandEnd::Kind::kUnknown)
      mirror_.Tell(
          "the link was lost while the scan was asked for: whether it runs shows when the "
          "link is back");
  });
  return {};
}

Status RemoteHead::StartStops(const StopPlan& plan, std::shared_ptr<StopSink> sink) {
  FORESIGHT_EXPECTS(sink != nullptr, "captures need somewhere to go");
  FORESIGHT_CHECK(plan.Check());
  FORESIGHT_CHECK(MayAct("capture"));
  const HeadState state = Status().state;
  if (state != HeadState::kReady)
    return Fail(ErrorCode::kState, "{}: cannot capture while {}{}", options_.address,
                ToString(state), state == HeadState::kDisconnected ? ": home it first" : "");
  const std::string id = NewUuid();
  link::Command command;
  *command.mutable_start_stops() = ToMessage(plan);
  command.mutable_start_stops()->set_stops_id(id);
  auto stops = std::make_shared<StopsClient>(session_, id, std::move(sink));
  const std::weak_ptr<StopsClient> asked = stops;
  {
    const std::lock_guard lock(mutex_);
    stops_.swap(stops);
  }
  stops.reset();  // the run before hears its end
  mirror_.Ask(HeadState::kSweeping, "asking the head to capture");
  commands_->Send(std::move(command), [this, asked](const CommandEnd& end) {
    const bool refused = end.kind == CommandEnd::Kind::kRefused;
    if (refused) mirror_.Tell("no captures: " + end.error.message);
    if (const auto run = asked.lock(); run && refused)
      run->Refuse(end.error.message);
    else if (run)
      run->Started();  // where nobody knows, the head says whether it has them
    if (end.outcome.has_status())
      static_cast<void>(mirror_.Take(end.outcome.status(), end.outcome.desk_time_s()));
    mirror_.Answered();
  });
  return {};
}

Status RemoteHead::StartLiveView(const LiveViewOptions& options,
                                 std::shared_ptr<LiveViewSink> sink) {
  FORESIGHT_EXPECTS(sink != nullptr, "images need somewhere to go");
  FORESIGHT_CHECK(options.Check());
  auto look = std::make_unique<LookClient>(session_, options, std::move(sink));
  const std::lock_guard lock(mutex_);
  look_.swap(look);
  return {};
}

void RemoteHead::StopLiveView() {
  std::unique_ptr<LookClient> look;
  const std::lock_guard lock(mutex_);
  look_.swap(look);
}

void RemoteHead::EndScan(const std::string& reason) {
  link::Command command;
  command.mutable_end_scan()->set_scan_id(mirror_.ScanOnHead());
  command.mutable_end_scan()->set_reason(reason);
  int asked = 0;
  {
    const std::lock_guard lock(mutex_);
    asked = ++ends_asked_;
    end_scan_ = StopAnswer::kWaiting;
  }
  commands_->Send(std::move(command),
                  [this, asked](const CommandEnd& end) { OnScanEndAnswer(asked, end); });
}

void RemoteHead::OnScanEndAnswer(int asked, const CommandEnd& end) {
  // Before the refusal: a scan that ended by itself meanwhile is none that sweeps on.
  if (end.outcome.has_status())
    static_cast<void>(mirror_.Take(end.outcome.status(), end.outcome.desk_time_s()));
  if (end.kind != CommandEnd::Kind::kDone)
    mirror_.Tell("the scan was not ended: " + end.error.message);
  const std::lock_guard lock(mutex_);
  // An end that was asked for meanwhile waits for its own answer.
  if (asked != ends_asked_) return;
  end_scan_refusal_.clear();
  switch (end.kind) {
    case CommandEnd::Kind::kDone:
      end_scan_ = StopAnswer::kObeyed;
      break;
    case CommandEnd::Kind::kRefused:
      end_scan_ = StopAnswer::kRefused;
      end_scan_refusal_ = end.error.message;
      break;
    case CommandEnd::Kind::kUnknown:
      end_scan_ = StopAnswer::kUnknown;
      break;
  }
}

void RemoteHead::StopMotor() {
  stopper_->Stop();
  commands_->VoidMoves();
}

void RemoteHead::OperatorSeen() {
  watch_->OperatorSeen();
}

}  // namespace foresight
