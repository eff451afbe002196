#include "hardware/link/server/head_desk.h"

#include <algorithm>

#include "core/base/contract.h"
#include "core/base/log.h"
#include "core/base/version.h"
#include "core/mission/plan_json.h"
#include "core/sensor/rig_id.h"
#include "hardware/link/protocol/messages.h"

namespace foresight {

Status CheckId(const char* what, const std::string& id) {
  const bool good = !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
  });
  if (good) return {};
  return Fail(ErrorCode::kInvalidInput, "{}: not 1 to 64 letters, digits and dashes", what);
}

HeadDesk::HeadDesk(std::shared_ptr<SensorHead> head, ScanShelf& shelf, const Options& options)
    : head_(std::move(head)),
      shelf_(shelf),
      options_(options),
      boot_id_(NewUuid()),
      start_(std::chrono::steady_clock::now()),
      lease_(options.lease_s),
      bursts_(shelf, options.burst_bytes_per_s) {
  FORESIGHT_EXPECTS(head_ != nullptr, "a desk has a head");
  FORESIGHT_EXPECTS(options_.stand == nullptr || options_.simulated,
                    "only a simulated world moves its stand");
  rig_id_ = RigId(head_->Rig());
}

double HeadDesk::Time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

link::IdentifyReply HeadDesk::Identify(const Peer& peer) const {
  link::IdentifyReply reply;
  reply.set_protocol(kLinkProtocol);
  reply.set_program(std::string("foresight-head ") + ProgramVersion());
  reply.set_description(head_->Describe());
  *reply.mutable_motion() = ToMessage(head_->Motion());
  reply.set_your_name(peer.name);
  reply.set_may_operate(peer.may_operate);
  reply.set_boot_id(boot_id_);
  reply.set_simulated(options_.simulated);
  reply.set_desk_time_s(Time());
  reply.set_has_stand(options_.stand != nullptr);
  const std::lock_guard lock(names_);
  reply.set_rig_id(rig_id_);
  return reply;
}

namespace {

link::ControlReply ToMessage(const ControlLease::Answer& answer, double lease_s) {
  link::ControlReply reply;
  reply.set_granted(answer.granted);
  reply.set_token(answer.token);
  reply.set_holder(answer.holder);
  reply.set_reason(answer.reason);
  reply.set_lease_s(lease_s);
  return reply;
}

}  // namespace

link::ControlReply HeadDesk::TakeControl(const link::ControlRequest& request, const Peer& peer) {
  if (!request.hand_over_to().empty())
    return ToMessage(lease_.HandOver(request.token(), request.hand_over_to(), Time()),
                     lease_.lease_s());
  if (!peer.may_operate)
    return ToMessage(
        ControlLease::Answer{false, "", Holder(),
                             "an observer's certificate cannot take control: use an operator's"},
        lease_.lease_s());
  const std::string before = Holder();
  const ControlLease::Answer answer = lease_.Take(peer.name, Time());
  if (answer.granted && before != peer.name) LogInfo("{} has control", peer.name);
  return ToMessage(answer, lease_.lease_s());
}

link::ControlReply HeadDesk::ReleaseControl(const link::ReleaseRequest& request) {
  return ToMessage(lease_.Release(request.token(), Time()), lease_.lease_s());
}

bool HeadDesk::SignOfLife(const std::string& token) {
  if (!lease_.Renew(token, Time())) return false;
  head_->OperatorSeen();
  return true;
}

Status HeadDesk::Check(const link::Command& command, const Peer& peer) const {
  if (!peer.may_operate)
    return Fail(ErrorCode::kState, "{} is an observer, who cannot command the head", peer.name);
  if (!lease_.Holds(command.control_token(), Time())) {
    const std::string holder = Holder();
    return Fail(ErrorCode::kState, "{} does not have control: {}", peer.name,
                holder.empty() ? "take it first" : holder + " has it");
  }
  if (command.boot_id() != boot_id_)
    return Fail(ErrorCode::kState,
                "the head's program was started anew since: look at its state and command again");
  if (!(command.void_after_s() >= Time()))
    return Fail(ErrorCode::kState,
                "the command came {:.1f} s too late and was not carried out: command again",
                Time() - command.void_after_s());
  if (Stopped(command))
    return Fail(ErrorCode::kState, "the head was stopped after that was asked for: command again");
  return {};
}

bool HeadDesk::Stopped(const link::Command& command) const {
  return Moves(command) && command.given_s() > 0.0 && command.given_s() <= stopped_s_;
}

link::Outcome HeadDesk::Execute(const link::Command& command, const Peer& peer) {
  const std::lock_guard lock(commands_);
  if (const Status id = CheckId("command_id", command.command_id()); !id) return ToMessage(id);
  if (auto before = log_.Find(command.command_id())) {
    before->set_repeated(true);
    return *before;
  }
  Status done = Check(command, peer);
  if (done) {
    lease_.Renew(command.control_token(), Time());
    head_->OperatorSeen();
    done = Carry(command);
    // A stop that came while the movement began.
    if (Stopped(command)) head_->StopMotor();
  }
  if (!done) LogWarning("{}: command refused: {}", peer.name, done.error().message);
  link::Outcome outcome = ToMessage(done);
  *outcome.mutable_status() = Now(false);
  outcome.set_desk_time_s(Time());
  log_.Keep(command.command_id(), outcome);
  return outcome;
}

Status HeadDesk::Carry(const link::Command& command) {
  switch (command.what_case()) {
    case link::Command::kHome:
      return head_->Home();
    case link::Command::kStartScan:
      return StartScan(command.start_scan());
    case link::Command::kEndScan:
      return EndScan(command.end_scan());
    case link::Command::kSetRig:
      return SetRig(command.set_rig());
    case link::Command::kStartStops:
      return StartStops(command.start_stops());
    case link::Command::kMoveStand:
      return MoveStand(command.move_stand());
    default:
      return Fail(ErrorCode::kInvalidInput, "the head does not know this command");
  }
}

Status HeadDesk::StartScan(const link::StartScan& start) {
  FORESIGHT_CHECK(CheckId("scan_id", start.scan_id()));
  FORESIGHT_TRY(const ScanPlan plan, PlanFromJson(start.plan_json(), "the station's plan"));
  FORESIGHT_TRY(const ScanPrediction expected, PredictScan(plan, head_->Rig(), head_->Motion()));
  FORESIGHT_TRY(const auto sink, shelf_.Begin(start.scan_id(), expected));
  if (const Status started = head_->StartScan(plan, sink); !started) {
    shelf_.Withdraw(start.scan_id());
    return started;
  }
  const std::lock_guard lock(names_);
  scan_id_ = start.scan_id();
  return {};
}

Status HeadDesk::EndScan(const link::EndScan& end) {
  std::string running;
  {
    const std::lock_guard lock(names_);
    running = scan_id_;
  }
  if (!end.scan_id().empty() && end.scan_id() != running)
    return Fail(ErrorCode::kState, "scan {} does not run, so it was not ended", end.scan_id());
  LogInfo("scan {} is to end: {}", end.scan_id(), end.reason());
  head_->EndScan(end.reason().empty() ? "the operator ended the scan" : end.reason());
  return {};
}

Status HeadDesk::SetRig(const link::SetRig& set) {
  FORESIGHT_TRY(const SensorRig rig, SensorRigFromYaml(set.yaml(), "the station's calibration"));
  FORESIGHT_CHECK(head_->SetRig(rig));
  const std::lock_guard lock(names_);
  rig_id_ = RigId(head_->Rig());
  return {};
}

Status HeadDesk::StartStops(const link::StartStops& start) {
  FORESIGHT_CHECK(CheckId("stops_id", start.stops_id()));
  FORESIGHT_TRY(const StopPlan plan, FromMessage(start));
  auto stops = std::make_shared<StopShelf>(start.stops_id());
  FORESIGHT_CHECK(head_->StartStops(plan, stops));
  const std::lock_guard lock(names_);
  stops_ = std::move(stops);
  return {};
}

/// Captures that run belong to where the stand is.
Status HeadDesk::MoveStand(const link::MoveStand& move) {
  if (options_.stand == nullptr)
    return Fail(ErrorCode::kState, "the stand of this head is carried, it does not move by itself");
  const HeadState state = head_->Status().state;
  if (state == HeadState::kSweeping || state == HeadState::kStopping)
    return Fail(ErrorCode::kState, "the stand cannot be moved while the head is {}",
                ToString(state));
  const auto places = static_cast<int>(options_.stand->Places().size());
  if (move.place() < 0 || move.place() > places)
    return Fail(ErrorCode::kInvalidInput, "the stand has {} places, and none {}", places,
                move.place());
  options_.stand->MoveTo(move.place() - 1);
  return {};
}

std::shared_ptr<StopShelf> HeadDesk::Stops(const std::string& id) const {
  const std::lock_guard lock(names_);
  return stops_ && stops_->id() == id ? stops_ : nullptr;
}

Status HeadDesk::StartLiveView(const LiveViewOptions& options, std::shared_ptr<LiveViewSink> sink) {
  const LiveViewSink* raw = sink.get();
  const std::lock_guard lock(names_);
  FORESIGHT_CHECK(head_->StartLiveView(options, std::move(sink)));
  shown_to_ = raw;
  return {};
}

bool HeadDesk::ShowsTo(const LiveViewSink* sink) const {
  const std::lock_guard lock(names_);
  return shown_to_ == sink;
}

void HeadDesk::StopLiveView(const LiveViewSink* sink) {
  const std::lock_guard lock(names_);
  if (shown_to_ != sink) return;
  shown_to_ = nullptr;
  head_->StopLiveView();
}

link::Outcome HeadDesk::Stop(const Peer& peer, double pressed_s) {
  link::Outcome outcome;
  if (peer.may_operate) {
    // NaN and a clock that runs ahead count as now.
    const double now = Time();
    const double pressed = pressed_s > 0.0 && pressed_s < now ? pressed_s : now;
    double before = stopped_s_;
    while (before < pressed && !stopped_s_.compare_exchange_weak(before, pressed)) {
    }
    head_->StopMotor();
    LogInfo("{} stopped the head", peer.name);
  } else {
    outcome = ToMessage(
        Status(Fail(ErrorCode::kState, "{} is an observer, who cannot stop the head", peer.name)));
  }
  *outcome.mutable_status() = Now(false);
  outcome.set_desk_time_s(Time());
  return outcome;
}

HeadFacts HeadDesk::Facts() const {
  HeadFacts facts;
  facts.simulated = options_.simulated;
  {
    const std::lock_guard lock(names_);
    facts.rig_id = rig_id_;
  }
  facts.find_scan = [this](const std::string& uuid) -> std::optional<ScanAtHead> {
    std::optional<ScanAtHead> found;
    const std::vector<ShelvedScan> scans = shelf_.List();
    for (const ShelvedScan& scan : scans) {
      if (scan.uuid != uuid) {
        // Oldest first: one behind it that has ended is newer.
        if (found && scan.state != ScanState::kRunning) found->is_newest = false;
        continue;
      }
      const auto age = std::chrono::steady_clock::now() - scan.begun;
      found =
          ScanAtHead{scan.rig_id, scan.simulated, std::chrono::duration<double>(age).count(), true};
    }
    return found;
  };
  return facts;
}

link::PoseReply HeadDesk::PublishPose(const link::PoseRequest& request, const Peer& peer) {
  link::PoseReply reply;
  reply.set_answer(ToString(RobotAnswer::Kind::kRefused));
  if (!peer.may_operate || !lease_.Renew(request.control_token(), Time())) {
    reply.set_reason(peer.name + " does not have control, so nothing was sent to the robot");
    return reply;
  }
  if (request.boot_id() != boot_id_ || !(request.void_after_s() >= Time())) {
    reply.set_reason("the pose came too late, and nothing was sent to the robot: send it again");
    return reply;
  }
  if (options_.gate == nullptr) {
    reply.set_reason(
        "the head has no socket for a robot: start foresight-head with --robot-socket");
    return reply;
  }
  const PoseGate::Outcome outcome = options_.gate->Publish(request.pose_json(), Facts());
  reply.set_answer(ToString(outcome.answer.kind));
  reply.set_reason(outcome.answer.reason);
  reply.set_repeated(outcome.repeated);
  LogInfo("{}: a pose to the robot: {} {}", peer.name, reply.answer(), reply.reason());
  return reply;
}

link::Status HeadDesk::Now(bool with_health) const {
  link::Status status = ToMessage(head_->Status(), with_health);
  status.set_free_bytes(shelf_.FreeBytes());
  if (options_.stand != nullptr) status.set_stand_at(options_.stand->At() + 1);
  const std::lock_guard lock(names_);
  status.set_scan_id(scan_id_);
  status.set_rig_id(rig_id_);
  return status;
}

Result<std::string> HeadDesk::RigYaml(const std::string& rig_id) const {
  const SensorRig rig = head_->Rig();
  if (rig_id.empty() || RigId(rig) == rig_id) return SensorRigToYaml(rig);
  return Fail(ErrorCode::kInvalidInput, "calibration {} is not in force here", rig_id.substr(0, 8));
}

}  // namespace foresight
