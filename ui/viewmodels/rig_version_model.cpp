#include "ui/viewmodels/rig_version_model.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QStandardPaths>
#include <chrono>

#include "core/base/utc_text.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

const QString kBeforeFile = QStringLiteral("rig_before.yaml");

QString ShortId(const SensorRig& rig) {
  return QString::fromStdString(ShortRigId(rig));
}

}  // namespace

RigVersionModel::RigVersionModel(HeadViewModel* head, SessionModel* session, QObject* parent)
    : QObject(parent), head_(head), session_(session) {
  connect(head_, &HeadViewModel::statusChanged, this, &RigVersionModel::changed);
  connect(&writer_, &TaskRunner::changed, this, &RigVersionModel::changed);
}

QString RigVersionModel::FreeFile(const QString& name) {
  const QDir folder(QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation))
                        .filePath(QStringLiteral("rigs")));
  folder.mkpath(QStringLiteral("."));
  const QString stem = QStringLiteral("%1-%2").arg(
      name, QDate::currentDate().toString(QStringLiteral("yyyy-MM-dd")));
  QString file = folder.filePath(stem + QStringLiteral(".yaml"));
  for (int version = 2; QFile::exists(file); ++version)
    file = folder.filePath(QStringLiteral("%1-v%2.yaml").arg(stem).arg(version));
  return file;
}

SensorRig RigVersionModel::ChildOfRigInForce() const {
  SensorRig rig = head_->Rig();
  rig.parent_id = RigId(rig);
  rig.date_utc = UtcDateNow();
  return rig;
}

SensorRig RigVersionModel::WithCamera(const CameraModel& camera) const {
  SensorRig rig = ChildOfRigInForce();
  rig.camera = camera;
  return rig;
}

SensorRig RigVersionModel::WithChain(const SensorRig& found) const {
  SensorRig rig = ChildOfRigInForce();
  rig.camera = found.camera;
  rig.camera_from_head = found.camera_from_head;
  rig.camera_from_lidar = found.camera_from_lidar;
  rig.lidar.range_offset_m = found.lidar.range_offset_m;
  rig.lidar.stamp_offset_s = found.lidar.stamp_offset_s;
  rig.angle_correction = found.angle_correction;
  return rig;
}

void RigVersionModel::Save(const SensorRig& rig, const QString& path) {
  const auto work = [rig, file = path.toStdString()](const RunContext&) -> Result<bool> {
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::symlink_status(file, error)))
      return Fail(ErrorCode::kIo,
                  "{}: the file exists and a version is never replaced: choose another name", file);
    FORESIGHT_CHECK(SaveSensorRig(rig, file));
    FORESIGHT_TRY(const SensorRig read, LoadSensorRig(file));
    if (RigId(read) != RigId(rig))
      return Fail(ErrorCode::kIo, "{}: what was read back is not what was written", file);
    return true;
  };
  writer_.Run<bool>(tr("Saving the rig"), work, [this, rig, path](const Result<bool>& saved) {
    if (!saved) {
      session_->Report(NoticeOf(tr("Saving the rig"), saved.error()));
      return;
    }
    saved_ = rig;
    saved_file_ = path;
    session_->Report({Notice::Level::kInfo, tr("Saved the rig %1 to %2.").arg(ShortId(rig), path),
                      tr("It is in force on the head when you put it in force.")});
    Q_EMIT changed();
  });
}

void RigVersionModel::Forget() {
  saved_.reset();
  saved_file_.clear();
  Q_EMIT changed();
}

void RigVersionModel::SetFolder(const QString& folder) {
  if (folder == folder_) return;
  folder_ = folder;
  before_.reset();
  const QString file = QDir(folder).filePath(kBeforeFile);
  if (!folder.isEmpty() && QFile::exists(file)) {
    if (auto rig = LoadSensorRig(file.toStdString()))
      before_ = std::move(*rig);
    else
      session_->Report(NoticeOf(tr("Reading the rig before"), rig.error()));
  }
  Q_EMIT changed();
}

QString RigVersionModel::WhyNotPutInForce() const {
  if (!saved_) return tr("Save the rig first.");
  if (head_->LastStatus().state != HeadState::kReady)
    return tr("The head is %1; it takes a rig while it is ready.")
        .arg(QString::fromUtf8(ToString(head_->LastStatus().state)));
  if (RigId(*saved_) == RigId(head_->Rig())) return tr("This rig is in force.");
  return Busy() ? tr("A rig is being written or put in force.") : QString();
}

QString RigVersionModel::WhyNotRollBack() const {
  if (!before_) return tr("No other rig was put in force here.");
  if (head_->LastStatus().state != HeadState::kReady)
    return tr("The head is %1; it takes a rig while it is ready.")
        .arg(QString::fromUtf8(ToString(head_->LastStatus().state)));
  if (RigId(*before_) == RigId(head_->Rig())) return tr("The rig before is in force.");
  return Busy() ? tr("A rig is being written or put in force.") : QString();
}

void RigVersionModel::putInForce() {
  if (const QString why = WhyNotPutInForce(); !why.isEmpty()) {
    session_->Report({Notice::Level::kInfo, tr("The rig cannot be put in force now."), why});
    return;
  }
  const SensorRig before = head_->Rig();
  // The way back must be on the disk before the head is changed.
  const auto keep = [before, file = QDir(folder_).filePath(kBeforeFile).toStdString(),
                     wanted = !folder_.isEmpty()](const RunContext&) -> Result<bool> {
    if (wanted) FORESIGHT_CHECK(SaveSensorRig(before, file));
    return true;
  };
  writer_.Run<bool>(tr("Keeping the rig before"), keep,
                    [this, before, rig = *saved_](const Result<bool>& kept) {
                      if (!kept) {
                        session_->Report(NoticeOf(tr("Keeping the rig before"), kept.error()));
                        return;
                      }
                      before_ = before;
                      Give(rig, tr("Putting the rig in force"));
                    });
}

void RigVersionModel::rollBack() {
  if (const QString why = WhyNotRollBack(); !why.isEmpty()) {
    session_->Report({Notice::Level::kInfo, tr("The rig cannot be rolled back now."), why});
    return;
  }
  Give(*before_, tr("Rolling the rig back"));
}

void RigVersionModel::Give(const SensorRig& rig, const QString& doing) {
  const auto give = [change = head_->RigChange(rig)](const RunContext&) -> Result<bool> {
    FORESIGHT_CHECK(change());
    return true;
  };
  writer_.Run<bool>(doing, give, [this, rig, doing](const Result<bool>& given) {
    if (!given) {
      session_->Report(NoticeOf(doing, given.error()));
    } else {
      head_->ShowRig();
      session_->Report({Notice::Level::kInfo,
                        tr("The rig %1 is in force on the head; it was read back and compared.")
                            .arg(ShortId(rig)),
                        tr("The next scan has it; scans that are there keep theirs.")});
    }
    Q_EMIT changed();
  });
}

}  // namespace foresight
