#pragma once

#include <QObject>
#include <QString>
#include <optional>

#include "core/sensor/sensor_rig.h"
#include "ui/viewmodels/head_view_model.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Versions of a head's calibration: a new one becomes a file of its own, is put in force on the
/// head, and can be taken back. No file is ever replaced.
class RigVersionModel : public QObject {
  Q_OBJECT

 public:
  RigVersionModel(HeadViewModel* head, SessionModel* session, QObject* parent = nullptr);

  /// A free name in the folder for rigs, `~/.local/share/foresight/workstation/rigs`.
  static QString FreeFile(const QString& name);

  /// The rig in force with another camera: its child, made now.
  SensorRig WithCamera(const CameraModel& camera) const;
  /// The same with another camera, motor and lidar: `found` is a calibration of the chain.
  SensorRig WithChain(const SensorRig& found) const;
  /// Writes a rig to a file that is not there yet, and reads it back.
  void Save(const SensorRig& rig, const QString& path);
  /// What was saved last; empty = nothing since Forget.
  const QString& SavedFile() const { return saved_file_; }
  /// The rig that was saved is of an earlier result.
  void Forget();

  /// Where the rig that was in force before is kept, so that it is found again after a crash.
  void SetFolder(const QString& folder);

  /// Why not, as a sentence; empty where it can be done.
  QString WhyNotPutInForce() const;
  QString WhyNotRollBack() const;
  bool Busy() const { return writer_.Busy(); }

 public Q_SLOTS:
  /// Gives the head what was saved last, and compares what the head then says it has.
  void putInForce();
  /// Gives the head the rig that it had before.
  void rollBack();

 Q_SIGNALS:
  void changed();

 private:
  SensorRig ChildOfRigInForce() const;
  void Give(const SensorRig& rig, const QString& doing);

  HeadViewModel* head_;
  SessionModel* session_;
  QString folder_;
  std::optional<SensorRig> saved_;
  QString saved_file_;
  std::optional<SensorRig> before_;
  TaskRunner writer_{session_->Tasks(), TaskPolicy::kNeverCancel};
};

}  // namespace foresight
