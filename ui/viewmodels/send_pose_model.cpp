#include "ui/viewmodels/send_pose_model.h"

#include <algorithm>

#include "core/base/utc_text.h"
#include "core/mission/new_records.h"
#include "core/mission/pose_json.h"

namespace foresight {
namespace {

QString AnswerText(const RobotAnswer& answer) {
  const QString reason = QString::fromStdString(answer.reason);
  const auto with_reason = [&](const QString& text) {
    return reason.isEmpty() ? text : text + QStringLiteral(": ") + reason;
  };
  switch (answer.kind) {
    case RobotAnswer::Kind::kAccepted:
      return with_reason(SendPoseModel::tr("accepted"));
    case RobotAnswer::Kind::kRefused:
      return with_reason(SendPoseModel::tr("refused"));
    case RobotAnswer::Kind::kNoAnswer:
      return with_reason(SendPoseModel::tr("no answer; it may have the pose"));
    case RobotAnswer::Kind::kNobodyThere:
      break;
  }
  return with_reason(SendPoseModel::tr("not connected to the head; it got nothing"));
}

}  // namespace

SendPoseModel::SendPoseModel(std::shared_ptr<SensorHead> head, SessionModel* live, QObject* parent)
    : QObject(parent), head_(std::move(head)), link_(head_->Link()), session_(live) {
  connect(session_, &SessionModel::objectsChanged, this, &SendPoseModel::changed);
  connect(&runner_, &TaskRunner::changed, this, &SendPoseModel::changed);
}

QString SendPoseModel::WhyNot() const {
  const FoundObject* object = session_->Selected();
  if (object == nullptr) return tr("No object is selected.");
  if (runner_.Busy()) return tr("A pose was sent; the robot has not answered yet.");
  if (!session_->IsCurrent(*object))
    return tr("The object is from an earlier scan, and the head may have moved. Scan again.");
  if (object->decision != Decision::kAccepted) return tr("Accept the object first (Ctrl+Return).");
  if (object->decided_candidate != session_->Candidate())
    return tr("You accepted another answer than the one that is shown. Accept this one first.");
  const auto message = Message(*object);
  if (!message) return QString::fromStdString(message.error().message);
  if (!message->is_winner)
    return tr("This is an alternative. Go back to the best answer (N), or fit again.");
  if (message->verdict == VerdictLevel::kUnsure)
    return tr("The verdict is UNSURE: a pose that is not known goes to no robot. Fit again.");
  const LinkHealth health = link_->Health();
  if (!health.connected) return tr("The link is lost. Wait until it is back.");
  return health.has_control ? QString() : tr("You do not have control of the head.");
}

Result<PoseMessage> SendPoseModel::Message(const FoundObject& object) const {
  const auto& scan = session_->ShownScan();
  if (!scan) return Fail(ErrorCode::kState, "there is no scan");
  PoseContext context;
  context.detection_uuid = object.uuid;
  context.sending = object.sendings + 1;
  context.decision = object.decision;
  context.decided_by = OperatorName();
  context.origin = session_->Mode() == SessionMode::kReplay ? PoseMessage::Origin::kReview
                                                            : PoseMessage::Origin::kLive;
  context.simulated = scan->simulated;
  context.scan_uuid = scan->uuid;
  context.scan_begin_utc_ns = BeginUtc_ns(*scan);
  context.age_s =
      std::max(0.0, 1e-9 * static_cast<double>(NowUtc_ns() - context.scan_begin_utc_ns));
  FORESIGHT_TRY(PoseMessage message,
                PoseMessageOf(object.detection, object.decided_candidate, object.rig, context));
  FORESIGHT_CHECK(CheckPoseMessage(message));
  return message;
}

void SendPoseModel::send() {
  if (!WhyNot().isEmpty()) return;
  const FoundObject& object = *session_->Selected();
  const auto message = Message(object);
  if (!message) return session_->Report(NoticeOf(tr("Sending the pose"), message.error()));
  session_->NoteRobot(object.uuid, tr("asked"));
  runner_.Run<RobotAnswer>(
      tr("Sending the pose to the robot"),
      [head = head_, link = link_, json = PoseMessageToJson(*message)](const RunContext&) {
        return link->SendPose(json);
      },
      [this, uuid = object.uuid](const Result<RobotAnswer>& answer) { Answered(uuid, answer); });
}

void SendPoseModel::Answered(const std::string& uuid, const Result<RobotAnswer>& answer) {
  if (!answer) {
    // The same number again: the robot carries it out once.
    session_->NoteRobot(uuid, tr("not known; send again, it is carried out once"));
    session_->Report(NoticeOf(tr("Sending the pose"), answer.error()));
    return;
  }
  const QString text = AnswerText(*answer);
  session_->KeepSending(uuid, text);
  if (answer->kind != RobotAnswer::Kind::kAccepted)
    session_->Report({Notice::Level::kWarning, tr("Pose to the robot: %1.").arg(text), {}});
}

}  // namespace foresight
