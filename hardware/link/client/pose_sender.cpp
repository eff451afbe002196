#include "hardware/link/client/pose_sender.h"

#include <thread>

namespace foresight {
namespace {

/// Within this time the head must have heard it: what the operator looked at is still so.
constexpr double kOrderGood_s = 8.0;
/// The head waits 2 s for the robot's answer; a line and its answer take 2.5 s at 9600 bit/s.
constexpr std::chrono::milliseconds kPoseTry{6000};
constexpr std::chrono::milliseconds kPosePause{200};

Result<RobotAnswer> FromMessage(const link::PoseReply& reply) {
  using Kind = RobotAnswer::Kind;
  for (const Kind kind : {Kind::kAccepted, Kind::kRefused, Kind::kNoAnswer, Kind::kNobodyThere})
    if (reply.answer() == ToString(kind)) return RobotAnswer{kind, reply.reason()};
  return Fail(ErrorCode::kBadData, "the head answers '{}' to a pose, which is no answer",
              reply.answer());
}

}  // namespace

Result<RobotAnswer> SendPose(LinkSession& session, const std::string& pose_json) {
  const double end_s = LinkSession::Now() + kOrderGood_s;
  link::PoseRequest request;
  request.set_pose_json(pose_json);
  request.set_void_after_s(session.DeskTime() + kOrderGood_s);
  request.set_boot_id(session.HeadIdentity().boot_id());
  for (;;) {
    request.set_control_token(session.Token());
    link::PoseReply reply;
    const auto context = LinkSession::Context(kPoseTry);
    const grpc::Status called = session.stub(*context)->PublishPose(context.get(), request, &reply);
    if (called.ok()) return FromMessage(reply);
    const bool lost = called.error_code() == grpc::StatusCode::UNAVAILABLE ||
                      called.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED;
    if (!lost || LinkSession::Now() > end_s)
      return tl::unexpected(session.ToError(called, "a pose to the robot"));
    std::this_thread::sleep_for(kPosePause);
  }
}

}  // namespace foresight
