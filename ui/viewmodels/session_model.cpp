#include "ui/viewmodels/session_model.h"

#include <algorithm>

#include "core/detection/candidates.h"
#include "ui/viewmodels/advice.h"

namespace foresight {
namespace {

const QString kRegionTopic = QStringLiteral("region");
const QString kObjectTopic = QStringLiteral("object");

}  // namespace

QDateTime BeginTimeOf(const Scan& scan) {
  if (scan.start_utc_ns == 0) return {};
  return QDateTime::fromMSecsSinceEpoch(BeginUtc_ns(scan) / 1'000'000);
}

SessionModel::SessionModel(SessionMode mode, TaskQueue* tasks, QObject* parent)
    : QObject(parent), mode_(mode), tasks_(tasks) {
  qRegisterMetaType<Notice>("foresight::Notice");
}

void SessionModel::SetScan(std::shared_ptr<const Scan> scan) {
  const bool same = scan && ShownScan() && ShownScan()->uuid == scan->uuid;
  scan_ = std::move(scan);
  expects_scan_ = false;
  image_index_ = -1;  // all of it before the first signal: who hears one may ask for anything
  depth_.reset();
  mask_.reset();
  cloud_.reset();
  part_ = {};
  arriving_.reset();
  if (!same) {
    roi_.reset();
    undo_.Forget(kRegionTopic);
  }
  Q_EMIT scanChanged();
  Q_EMIT cloudChanged();
  Q_EMIT roiChanged();
  Q_EMIT objectsChanged();  // those of the scan before are no longer current
  SelectImage(scan_ && !scan_->frames.empty() ? 0 : -1);
}

void SessionModel::ExpectScan() {
  SetScan(nullptr);
  expects_scan_ = true;
  Q_EMIT scanChanged();
}

void SessionModel::SetArriving(std::shared_ptr<const Scan> scan) {
  const std::shared_ptr<const Scan> before = std::exchange(arriving_, std::move(scan));
  const std::size_t images_before = before ? before->frames.size() : 0;
  const std::size_t images = arriving_ ? arriving_->frames.size() : 0;
  // Over a link a small image comes first, and then the real one in its place.
  bool same = images == images_before;
  for (std::size_t i = 0; same && i < images; ++i)
    same = arriving_->frames[i].image.data() == before->frames[i].image.data();
  if (same) return;
  Q_EMIT scanChanged();
  SelectImage(images == 0 ? -1 : std::max(0, image_index_));
}

void SessionModel::GiveUpScan() {
  expects_scan_ = false;
  SetArriving(nullptr);
  Q_EMIT scanChanged();
}

void SessionModel::SetEarlier(const EarlierContents& earlier) {
  if (earlier == earlier_) return;
  earlier_ = earlier;
  Q_EMIT earlierChanged();
}

QDateTime SessionModel::ScanTime() const {
  return ShownScan() ? BeginTimeOf(*ShownScan()) : QDateTime();
}

void SessionModel::SelectImage(int index) {
  const int count = ShownScan() ? static_cast<int>(ShownScan()->frames.size()) : 0;
  image_index_ = index >= 0 && index < count ? index : -1;
  Q_EMIT imageChanged();
  SetDepth(nullptr);
}

const CameraFrame* SessionModel::CurrentImage() const {
  return image_index_ < 0 ? nullptr : &ShownScan()->frames[static_cast<std::size_t>(image_index_)];
}

void SessionModel::SetCloud(std::shared_ptr<const RegisteredScan> cloud, const SensorRig& rig,
                            CloudPart part) {
  if (tasks_ != nullptr) tasks_->Discard(std::move(cloud_));
  cloud_ = std::move(cloud);
  part_ = std::move(part);
  rig_ = rig;
  Q_EMIT cloudChanged();
}

void SessionModel::SetDepth(std::shared_ptr<const DepthResult> depth) {
  depth_ = std::move(depth);
  mask_ = depth_ ? std::make_shared<const MaskImage>(depth_->mask) : nullptr;
  if (depth_) mask_options_ = depth_->options.mask;
  Q_EMIT depthChanged();
}

void SessionModel::SetDepthComing(bool coming) {
  if (coming == depth_coming_) return;
  depth_coming_ = coming;
  Q_EMIT depthComingChanged();
}

void SessionModel::SetMask(std::shared_ptr<const MaskImage> mask,
                           const ConfidenceMaskOptions& options) {
  mask_ = std::move(mask);
  mask_options_ = options;
  Q_EMIT maskChanged();
}

void SessionModel::SetRoi(std::optional<Roi> roi) {
  undo_.Push(
      tr("Draw region"), kRegionTopic, [this, before = roi_] { ShowRoi(before); },
      [this, roi] { ShowRoi(roi); });
  ShowRoi(std::move(roi));
}

void SessionModel::ShowRoi(std::optional<Roi> roi) {
  roi_ = std::move(roi);
  Q_EMIT roiChanged();
}

void SessionModel::AddObject(FoundObject object) {
  const bool late = !IsCurrent(object);
  // The operator may be about to accept what is selected in the scan on the screen.
  const bool select = !late || Selected() == nullptr || !IsCurrent(*Selected());
  List(std::move(object), select);
  if (late)
    Report({Notice::Level::kInfo, tr("A fit in the scan before has ended."),
            tr("What it found is the last object in the list.")});
}

void SessionModel::List(FoundObject object, bool select) {
  objects_.push_back(std::move(object));
  if (select)
    SelectObject(static_cast<int>(objects_.size()) - 1);
  else
    Q_EMIT objectsChanged();
  Q_EMIT objectAdded(objects_.back());
}

void SessionModel::ShowObjects(std::vector<FoundObject> objects) {
  undo_.Forget(kObjectTopic);
  objects_ = std::move(objects);
  SelectObject(static_cast<int>(objects_.size()) - 1);
}

FoundObject* SessionModel::Find(const std::string& uuid) {
  for (FoundObject& object : objects_)
    if (object.uuid == uuid) return &object;
  return nullptr;
}

void SessionModel::MarkKept(const std::string& uuid) {
  FoundObject* object = Find(uuid);
  if (object == nullptr || object->kept) return;
  object->kept = true;
  Q_EMIT objectsChanged();
}

void SessionModel::Touch(const ObjectEvent& event) {
  if (FoundObject* object = Find(event.uuid)) {
    switch (event.action) {
      case DetectionEvent::Action::kAccepted:
        object->decision = Decision::kAccepted;
        object->decided_candidate = event.candidate;
        break;
      case DetectionEvent::Action::kRejected:
        object->decision = Decision::kRejected;
        object->decided_candidate = event.candidate;
        break;
      case DetectionEvent::Action::kReopened:
        object->decision = Decision::kOpen;
        object->decided_candidate = 0;
        break;
      case DetectionEvent::Action::kRenamed:
        object->name = event.text;
        break;
      case DetectionEvent::Action::kSent:
        ++object->sendings;
        object->robot = event.text;
        break;
      case DetectionEvent::Action::kDeleted:
      case DetectionEvent::Action::kRestored:
        break;
    }
  }
  if (event.action != DetectionEvent::Action::kSent &&
      event.action != DetectionEvent::Action::kRenamed)
    Q_EMIT settled(DecisionTopic(event.uuid));
  Q_EMIT objectTouched(event);
  Q_EMIT objectsChanged();
}

void SessionModel::Decide(Decision decision) {
  const FoundObject* object = Selected();
  if (object == nullptr) return;
  const int decided = decision == Decision::kOpen ? 0 : candidate_;
  if (object->decision == decision && object->decided_candidate == decided) return;
  // What was on the screen is what was decided on: a surface of a terrain, or an alternative.
  const auto event = [uuid = object->uuid](Decision value, int candidate) {
    // Not translated: it is read back from the mission.
    const QString which =
        candidate > 0 ? QStringLiteral("answer %1").arg(candidate + 1) : QString();
    const DetectionEvent::Action action =
        value == Decision::kAccepted   ? DetectionEvent::Action::kAccepted
        : value == Decision::kRejected ? DetectionEvent::Action::kRejected
                                       : DetectionEvent::Action::kReopened;
    return ObjectEvent{uuid, action, which, candidate};
  };
  const QString text = decision == Decision::kAccepted   ? tr("Accept object")
                       : decision == Decision::kRejected ? tr("Reject object")
                                                         : tr("Take a decision back");
  const auto decide = [this, event, uuid = object->uuid](Decision value, int candidate) {
    Touch(event(value, candidate));
    const FoundObject* decided_on = Find(uuid);
    if (value == Decision::kAccepted && decided_on != nullptr) WarnOfUnsure(*decided_on);
  };
  undo_.Push(
      text, kObjectTopic,
      [decide, before = object->decision, candidate = object->decided_candidate] {
        decide(before, candidate);
      },
      [decide, decision, decided] { decide(decision, decided); });
  decide(decision, decided);
}

/// The operator may know better; nobody is to overlook it.
void SessionModel::WarnOfUnsure(const FoundObject& accepted) {
  const int candidate = accepted.decided_candidate;
  if (CandidateLevel(accepted.detection, candidate) != VerdictLevel::kUnsure) return;
  QString why = ReasonFor(accepted.detection, candidate);
  const auto behind = MarginBehindBest(accepted.detection, candidate);
  if (behind && *behind >= kComparable_nats)
    why = tr("the best answer explains the measurements better.");
  else if (why.isEmpty())  // it is UNSURE because the best answer is
    why = QString::fromStdString(VerdictOf(accepted.detection).reason);
  Report({Notice::Level::kWarning, tr("Accepted although UNSURE: %1").arg(why),
          tr("Do not act on it without another look. Ctrl+Z takes it back."),
          DecisionTopic(accepted.uuid)});
}

void SessionModel::KeepSending(const std::string& uuid, const QString& answer) {
  Touch({uuid, DetectionEvent::Action::kSent, answer});
}

void SessionModel::NoteRobot(const std::string& uuid, const QString& text) {
  FoundObject* object = Find(uuid);
  if (object == nullptr) return;
  object->robot = text;
  Q_EMIT objectsChanged();
}

void SessionModel::RenameSelected(const QString& name) {
  const FoundObject* object = Selected();
  if (object == nullptr || object->name == name) return;
  const ObjectEvent back{object->uuid, DetectionEvent::Action::kRenamed, object->name};
  const ObjectEvent forth{object->uuid, DetectionEvent::Action::kRenamed, name};
  undo_.Push(
      tr("Rename object"), kObjectTopic, [this, back] { Touch(back); },
      [this, forth] { Touch(forth); });
  Touch(forth);
}

void SessionModel::Remove(const std::string& uuid) {
  const auto at = std::find_if(objects_.begin(), objects_.end(),
                               [&](const FoundObject& object) { return object.uuid == uuid; });
  if (at == objects_.end()) return;
  const int index = static_cast<int>(at - objects_.begin());
  objects_.erase(at);
  SelectObject(std::min(index, static_cast<int>(objects_.size()) - 1));
}

void SessionModel::Insert(const FoundObject& object, std::size_t at) {
  at = std::min(at, objects_.size());
  objects_.insert(objects_.begin() + static_cast<std::ptrdiff_t>(at), object);
  SelectObject(static_cast<int>(at));
}

void SessionModel::RemoveSelected() {
  if (Selected() == nullptr) return;
  const auto at = static_cast<std::size_t>(selected_object_);
  const FoundObject object = *Selected();
  const auto remove = [this, uuid = object.uuid] {
    Remove(uuid);
    Touch({uuid, DetectionEvent::Action::kDeleted, {}});
  };
  undo_.Push(
      tr("Delete object"), kObjectTopic,
      [this, object, at] {
        Insert(object, at);
        Touch({object.uuid, DetectionEvent::Action::kRestored, {}});
      },
      remove);
  remove();
}

void SessionModel::CopySelected() {
  if (Selected() == nullptr) return;
  FoundObject copy = *Selected();
  copy.uuid = NewUuid();
  copy.decision = Decision::kOpen;
  copy.decided_candidate = 0;
  copy.kept = false;
  copy.robot.clear();  // it was not sent
  copy.sendings = 0;
  if (!copy.name.isEmpty()) copy.name = tr("Copy of %1").arg(copy.name);
  List(std::move(copy), true);
}

void SessionModel::SelectObject(int index) {
  selected_object_ = index >= 0 && index < static_cast<int>(objects_.size()) ? index : -1;
  candidate_ = selected_object_ < 0 ? 0 : AcceptedCandidate(*Selected());
  Q_EMIT objectsChanged();
}

const FoundObject* SessionModel::Selected() const {
  return selected_object_ < 0 ? nullptr : &objects_[static_cast<std::size_t>(selected_object_)];
}

void SessionModel::StepCandidate(int by) {
  const FoundObject* object = Selected();
  if (object == nullptr) return;
  const int count = CandidateCount(object->detection);
  if (count < 2) return;
  candidate_ = (candidate_ + by + count) % count;
  Q_EMIT objectsChanged();
}

bool SessionModel::IsCurrent(const FoundObject& object) const {
  return ShownScan() && ShownScan()->uuid == object.scan_uuid;
}

}  // namespace foresight
