#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/depth/pipeline.h"
#include "core/detection/detection.h"
#include "core/mission/mission_records.h"
#include "core/mission/scan_part.h"
#include "core/registration/register_scan.h"
#include "core/sensor/scan.h"
#include "ui/viewmodels/notes_model.h"
#include "ui/viewmodels/notice.h"
#include "ui/viewmodels/task_queue.h"
#include "ui/viewmodels/undo_stack.h"

namespace foresight {

/// Where the data of a document come from.
enum class SessionMode { kLive, kSimulation, kReplay };

/// An object that was found, with where it comes from and what the operator made of it.
struct FoundObject {
  Detection detection;
  SensorRig rig;  ///< of the scan it was found in
  std::string scan_uuid;
  QDateTime scan_time;
  std::chrono::steady_clock::time_point found = std::chrono::steady_clock::now();
  std::string uuid = NewUuid();  ///< of this object, in every file that keeps it
  QString name;                  ///< the operator's; empty = none was given
  Decision decision = Decision::kOpen;
  int decided_candidate = 0;     ///< which answer the decision is about
  int sendings = 0;              ///< that the robot's side answered
  QString robot;                 ///< what became of the last one; empty = the pose was not sent
  std::string provenance_json;   ///< all that is needed to make it again (core/mission)
  bool kept = false;             ///< it is on the disk
  std::optional<ScanPart> part;  ///< it was made from, before all lines were here
  bool by_robot = false;         ///< the head fitted it
};

/// The answer that stands for the object: the one that was accepted, else the best.
inline int AcceptedCandidate(const FoundObject& object) {
  return object.decision == Decision::kAccepted ? object.decided_candidate : 0;
}

/// Of what lines the cloud is while its scan is not whole.
struct CloudPart {
  std::shared_ptr<const Scan>
      scan;       ///< with the lines of the cloud; nullptr = thinned ones: nothing is fitted to it
  int lines = 0;  ///< 0 = the cloud is of a whole scan
  int of_lines = 0;  ///< expected; 0 = not known
};

/// BeginUtc_ns of a scan; invalid where the head did not know the time.
QDateTime BeginTimeOf(const Scan& scan);

/// What a mission held before this sitting.
struct EarlierContents {
  int scans = 0;
  int objects = 0;        ///< without those that were deleted
  int notes = 0;          ///< with measurements
  QDateTime interrupted;  ///< when its last scan began, if that was interrupted; else invalid

  bool operator==(const EarlierContents&) const = default;
};

/// What the operator does to an object that is there.
struct ObjectEvent {
  std::string uuid;
  DetectionEvent::Action action = DetectionEvent::Action::kReopened;
  QString text;  ///< the new name, the robot's answer, or which answer a decision is about where it
                 ///< is not the best one
  int candidate = 0;  ///< that a decision is about
};

/// A document: the current scan and all that was made from it. Every part is immutable and replaced
/// as a whole; a part that no longer fits the scan is dropped, never shown as current. The program
/// has two, the live one and the one for review, and never moves anything from one to the other.
class SessionModel : public QObject {
  Q_OBJECT

 public:
  /// Without a queue the tasks of each view-model have one of their own.
  explicit SessionModel(SessionMode mode, TaskQueue* tasks = nullptr, QObject* parent = nullptr);

  SessionMode Mode() const { return mode_; }
  /// Where the work of all that belongs to this document is done.
  TaskQueue* Tasks() const { return tasks_; }
  UndoStack* Undo() { return &undo_; }
  /// What was written down and measured.
  NotesModel* Notes() { return &notes_; }
  const NotesModel* Notes() const { return &notes_; }

  /// A new scan: drops the points and depth of the one before and, unless that was an earlier part
  /// of the same scan, the region; found objects stay listed.
  void SetScan(std::shared_ptr<const Scan> scan);
  const std::shared_ptr<const Scan>& CurrentScan() const { return scan_; }
  /// Drops the scan as SetScan(nullptr) does, because a new one is on its way.
  void ExpectScan();
  bool ExpectsScan() const { return expects_scan_; }
  /// What has come of the scan that is expected: its images are shown as they are taken.
  void SetArriving(std::shared_ptr<const Scan> scan);
  /// The current scan or, while one is on its way, what has come of it; nullptr = neither.
  const std::shared_ptr<const Scan>& ShownScan() const { return scan_ ? scan_ : arriving_; }
  /// The scan that was expected will not come.
  void GiveUpScan();
  QDateTime ScanTime() const;
  /// What the mission file held when the session went on in it.
  const EarlierContents& Earlier() const { return earlier_; }
  void SetEarlier(const EarlierContents& earlier);

  void SelectImage(int index);
  int ImageIndex() const { return image_index_; }
  const CameraFrame* CurrentImage() const;

  /// The points of the current scan, or of the part of it that has arrived.
  void SetCloud(std::shared_ptr<const RegisteredScan> cloud, const SensorRig& rig,
                CloudPart part = {});
  const std::shared_ptr<const RegisteredScan>& Cloud() const { return cloud_; }
  /// Of what lines it is.
  const CloudPart& Part() const { return part_; }
  /// What a fit is made in: the current scan or, while one is on its way, the part that the cloud
  /// is of; nullptr = neither.
  const std::shared_ptr<const Scan>& ScanToFit() const { return scan_ ? scan_ : part_.scan; }
  /// The calibration that belongs to the points.
  const SensorRig& Rig() const { return rig_; }

  void SetDepth(std::shared_ptr<const DepthResult> depth);
  const std::shared_ptr<const DepthResult>& Depth() const { return depth_; }
  /// Whether the first depth of the image is being computed.
  bool DepthComing() const { return depth_coming_; }
  void SetDepthComing(bool coming);
  /// A mask of the depth map, and what made it.
  void SetMask(std::shared_ptr<const MaskImage> mask, const ConfidenceMaskOptions& options);
  const ConfidenceMaskOptions& MaskOptions() const { return mask_options_; }
  const std::shared_ptr<const MaskImage>& Mask() const { return mask_; }

  /// The region the operator drew; can be undone.
  void SetRoi(std::optional<Roi> roi);
  const std::optional<Roi>& Region() const { return roi_; }

  /// A new object; `objectAdded` asks for it to be kept. It is selected at once, but where it is of
  /// an earlier scan it takes no selection from an object of the scan that is shown.
  void AddObject(FoundObject object);
  /// Objects out of a file, in place of those that are listed.
  void ShowObjects(std::vector<FoundObject> objects);
  /// Its record is on the disk.
  void MarkKept(const std::string& uuid);
  const std::vector<FoundObject>& Objects() const { return objects_; }
  int SelectedObject() const { return selected_object_; }
  void SelectObject(int index);
  /// The selected object; nullptr = none.
  const FoundObject* Selected() const;
  /// Which answer of the selected object is looked at: 0 = the best (core/detection/candidates.h).
  int Candidate() const { return candidate_; }
  /// The candidate that is drawn of an object.
  int CandidateOf(std::size_t index) const {
    return static_cast<int>(index) == selected_object_ ? candidate_
                                                       : AcceptedCandidate(objects_[index]);
  }
  /// Whether a found object belongs to the scan on the screen.
  bool IsCurrent(const FoundObject& object) const;

  /// What the operator decided on the selected object; can be undone.
  void Decide(Decision decision);
  void RenameSelected(const QString& name);
  void RemoveSelected();
  /// A second object like the selected one, not decided on.
  void CopySelected();

  /// The pose was sent and this came back; not undone.
  void KeepSending(const std::string& uuid, const QString& answer);
  /// What shows with the object until the answer comes.
  void NoteRobot(const std::string& uuid, const QString& text);

  void Report(const Notice& notice) { Q_EMIT noticed(notice); }

 public Q_SLOTS:
  /// The next or the last candidate of the selected object, round and round.
  void nextCandidate() { StepCandidate(1); }
  void previousCandidate() { StepCandidate(-1); }

 Q_SIGNALS:
  void scanChanged();
  void earlierChanged();
  void imageChanged();
  void cloudChanged();
  void depthChanged();
  void depthComingChanged();
  void maskChanged();
  void roiChanged();
  void objectsChanged();
  void objectAdded(const foresight::FoundObject& object);
  void objectTouched(const foresight::ObjectEvent& event);
  void noticed(const foresight::Notice& notice);
  /// What earlier notices of this topic said no longer holds.
  void settled(const QString& topic);

 private:
  void List(FoundObject object, bool select);
  void StepCandidate(int by);
  void ShowRoi(std::optional<Roi> roi);
  FoundObject* Find(const std::string& uuid);
  void Touch(const ObjectEvent& event);
  void WarnOfUnsure(const FoundObject& accepted);
  void Insert(const FoundObject& object, std::size_t at);
  void Remove(const std::string& uuid);

  SessionMode mode_;
  TaskQueue* tasks_;
  UndoStack undo_;
  NotesModel notes_{&undo_};
  std::shared_ptr<const Scan> scan_;
  bool expects_scan_ = false;
  EarlierContents earlier_;
  std::shared_ptr<const Scan> arriving_;
  int image_index_ = -1;
  std::shared_ptr<const RegisteredScan> cloud_;
  CloudPart part_;
  SensorRig rig_;
  std::shared_ptr<const DepthResult> depth_;
  bool depth_coming_ = false;
  std::shared_ptr<const MaskImage> mask_;
  ConfidenceMaskOptions mask_options_;
  std::optional<Roi> roi_;
  std::vector<FoundObject> objects_;
  int selected_object_ = -1;
  int candidate_ = 0;
};

}  // namespace foresight

Q_DECLARE_METATYPE(foresight::FoundObject)
Q_DECLARE_METATYPE(foresight::ObjectEvent)
