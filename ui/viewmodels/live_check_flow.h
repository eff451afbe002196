#pragma once

#include <QObject>

#include "ui/viewmodels/recording_view_model.h"
#include "ui/viewmodels/scan_check_model.h"

namespace foresight {

/// Keeps the checks of the live session with its mission. Reads the checks of a mission that is
/// continued for the live lamp.
class LiveCheckFlow : public QObject {
  Q_OBJECT

 public:
  LiveCheckFlow(RecordingViewModel* recording, SessionModel* session, ScanCheckModel* check,
                QObject* parent = nullptr);

 private:
  void FollowMission();

  RecordingViewModel* recording_;
  SessionModel* session_;
  ScanCheckModel* check_;
  TaskRunner reader_{session_->Tasks()};
  QString path_;        ///< of the mission whose checks the lamp knows
  bool asked_ = false;  ///< the mission was asked for the checks that it has
};

}  // namespace foresight
