#pragma once

#include <QObject>
#include <QString>
#include <memory>

#include "core/mission/pose_message.h"
#include "hardware/api/head_link.h"
#include "hardware/api/sensor_head.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Sends the selected object's pose to the robot by way of the head, and shows the robot's answer
/// with the object. Only what the operator accepted, from the scan on the screen, with a verdict
/// that is not UNSURE; the head judges once more by its own rules.
class SendPoseModel : public QObject {
  Q_OBJECT

 public:
  /// `head` has a link.
  SendPoseModel(std::shared_ptr<SensorHead> head, SessionModel* live, QObject* parent = nullptr);

  /// Why the pose cannot be sent now, as a sentence; empty when it can.
  QString WhyNot() const;

 public Q_SLOTS:
  void send();

 Q_SIGNALS:
  void changed();

 private:
  Result<PoseMessage> Message(const FoundObject& object) const;
  void Answered(const std::string& uuid, const Result<RobotAnswer>& answer);

  std::shared_ptr<SensorHead> head_;
  HeadLink* link_;  ///< of head_
  SessionModel* session_;
  /// What was sent is on its way: nothing calls it back.
  TaskRunner runner_{session_->Tasks(), TaskPolicy::kNeverCancel};
};

}  // namespace foresight
