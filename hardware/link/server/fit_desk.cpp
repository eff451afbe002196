#include "hardware/link/server/fit_desk.h"

#include <nlohmann/json.hpp>

#include "core/base/log.h"
#include "core/base/thread_priority.h"
#include "core/base/version.h"
#include "core/detection/detection_json.h"
#include "core/io/json_reader.h"
#include "core/registration/final_part.h"
#include "core/sensor/rig_id.h"
#include "hardware/link/protocol/messages.h"
#include "hardware/link/server/head_desk.h"

namespace foresight {
namespace {

constexpr std::chrono::milliseconds kFitTick{50};

Status TakeImage(const Scan& scan, link::ImageChoice choice, Provenance& provenance) {
  auto* region = std::get_if<ImageRoi>(&*provenance.roi);
  if (choice == link::AS_THE_PROVENANCE_SAYS || (region == nullptr && !provenance.depth)) return {};
  const bool nearest = choice == link::NEAREST_TO_THE_REGION && region != nullptr;
  const double middle_rad = 0.5 * (scan.plan.from_rad + scan.plan.to_rad);
  const CameraFrame* frame = NearestFrame(scan, nearest ? region->motor_rad : middle_rad);
  if (frame == nullptr)
    return Fail(ErrorCode::kInvalidInput, "scan {} has no image yet: ask again, or give a box",
                scan.uuid);
  if (region != nullptr) region->motor_rad = frame->motor_angle_rad;
  for (std::size_t i = 0; provenance.depth && i < scan.frames.size(); ++i)
    if (scan.frames[i].seq == frame->seq) provenance.image_position = static_cast<std::int64_t>(i);
  return {};
}

}  // namespace

FitDesk::~FitDesk() {
  std::jthread worker;
  {
    const std::lock_guard lock(mutex_);
    worker = std::move(worker_);
  }
}

Result<FitDesk::Order> FitDesk::OrderFrom(const link::FitRequest& request,
                                          const std::string& caller) {
  FORESIGHT_CHECK(CheckId("command_id", request.command_id()));
  Order order{request.command_id(), caller, request.scan_id(), {}, request.image()};
  if (request.cancel()) return order;
  auto provenance = ProvenanceFromJson(request.provenance_json(), "a fit of " + caller);
  if (!provenance) return Fail(ErrorCode::kInvalidInput, "{}", provenance.error().message);
  if (!provenance->fit || !provenance->roi)
    return Fail(ErrorCode::kInvalidInput, "a fit of {}: its provenance names no fit and region",
                caller);
  order.provenance = std::move(*provenance);
  order.provenance.part.reset();
  return order;
}

Result<link::FitReply> FitDesk::Fit(const link::FitRequest& request, const std::string& caller,
                                    const std::function<bool()>& gone) {
  FORESIGHT_TRY(Order order, OrderFrom(request, caller));
  const std::string id = order.command_id;
  std::unique_lock lock(mutex_);
  const auto known = log_.Find(id);
  if (request.cancel()) {
    if (running_id_ == id && running_for_ == caller) worker_.request_stop();
  } else if (!known && running_id_ != id) {
    FORESIGHT_TRY(const auto scan, shelf_.Find(order.scan_id));
    FORESIGHT_CHECK(Begin(std::move(order), lock));
  }
  while (running_id_ == id) {
    if (gone()) return Fail(ErrorCode::kCancelled, "{} is gone: its fit goes on", caller);
    changed_.wait_for(lock, kFitTick);
  }
  auto reply = log_.Find(id);
  if (!reply) return Fail(ErrorCode::kCancelled, "there is no fit {}", id);
  reply->set_repeated(known.has_value());
  return *std::move(reply);
}

/// With the mutex held, which is given up where another fit has to end first.
Status FitDesk::Begin(Order order, std::unique_lock<std::mutex>& lock) {
  if (!running_id_.empty() && running_for_ != order.caller)
    return Fail(ErrorCode::kState, "a fit of {} is being made: ask again in a few seconds",
                running_for_);
  if (!running_id_.empty()) worker_.request_stop();
  changed_.wait(lock, [this] { return running_id_.empty(); });
  running_id_ = order.command_id;
  running_for_ = order.caller;
  if (worker_.joinable()) worker_.join();  // it is done
  worker_ = std::jthread(
      [this, order = std::move(order)](const std::stop_token& stop) { Work(order, stop); });
  return {};
}

void FitDesk::Work(const Order& order, const std::stop_token& stop) {
  LetOthersGoFirst();
  RunContext context;
  context.stop = stop;
  auto made = Make(order, context);
  link::FitReply reply;
  if (made)
    reply = std::move(*made);
  else
    *reply.mutable_failure() = ToMessage(Status(tl::unexpected(made.error())));
  LogInfo("{}: a fit in scan {}: {}", order.caller, order.scan_id,
          made ? "made" : made.error().message);
  const std::lock_guard lock(mutex_);
  log_.Keep(order.command_id, std::move(reply));
  running_id_.clear();
  running_for_.clear();
  changed_.notify_all();
}

Result<link::FitReply> FitDesk::Make(const Order& order, const RunContext& context) {
  FORESIGHT_TRY(const ShelvedScan shelved, shelf_.Find(order.scan_id));
  FORESIGHT_TRY(auto scan, shelf_.Snapshot(order.scan_id));
  Provenance provenance = order.provenance;
  provenance.program_version = ProgramVersion();
  if (provenance.rig_id.empty()) provenance.rig_id = RigId(scan->rig);
  FORESIGHT_CHECK(TakeImage(*scan, order.image, provenance));
  if (scan->state == ScanState::kRunning) {
    scan = std::make_shared<const Scan>(FinalPart(*scan));
    provenance.part = PartOf(*scan, shelved.expected_lines);
  }
  if (bench_.scan() != scan) FORESIGHT_CHECK(bench_.Take(scan, context.Part(0.0, 0.2)));
  FORESIGHT_TRY(const Detection found, bench_.Fit(provenance, context.Part(0.2, 1.0)));
  link::FitReply reply;
  // In one line: on a thin link its indentation would be a third of it.
  reply.set_detection_json(ParseJson(DetectionToJson(found, scan->rig.robot_from_base)).dump());
  reply.set_provenance_json(ProvenanceToJson(provenance));
  reply.set_scan_state(ToString(scan->state));
  reply.set_scan_reason(scan->reason);
  return reply;
}

}  // namespace foresight
