#include "ui/viewmodels/scan_check_model.h"

#include <exception>
#include <thread>

#include "core/base/thread_priority.h"
#include "ui/viewmodels/mission_objects.h"

namespace foresight {
namespace {

/// Runs `work` on one thread that all others of this computer go before: the threads of the task
/// queue keep their priority, and a thread that was lowered stays so.
template <class T>
Result<T> AfterAllOthers(const std::function<Result<T>(const RunContext&)>& work,
                         RunContext context) {
  context.threads = 1;
  Result<T> answer = Fail(ErrorCode::kCancelled, "it did not run");
  std::exception_ptr failure;
  std::thread thread([&] {
    LetOthersGoFirst();
    try {
      answer = work(context);
    } catch (...) {
      failure = std::current_exception();
    }
  });
  thread.join();
  if (failure) std::rethrow_exception(failure);
  return answer;
}

struct CheckJob {
  std::shared_ptr<const Scan> scan;
  std::shared_ptr<const RegisteredScan> cloud;
  int image = -1;
  ScanCheckOptions options;
  std::vector<DetectionRecord> accepted;

  Result<KeptCheck> operator()(const RunContext& context) const {
    std::vector<std::string> left_out;
    const std::vector<KeptObject> objects = AcceptedObjects(*scan, accepted, left_out);
    const CameraFrame* frame = image < 0 ? nullptr : &scan->frames[static_cast<std::size_t>(image)];
    FORESIGHT_TRY(ScanCheck check, CheckScan(*scan, *cloud, frame, objects, options, context));
    check.cannot_see.insert(check.cannot_see.end(), left_out.begin(), left_out.end());
    return NewKeptCheck(*scan, check, options);
  }
};

}  // namespace

ScanCheckModel::ScanCheckModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  connect(session_, &SessionModel::scanChanged, this, &ScanCheckModel::FollowScan);
  connect(session_, &SessionModel::cloudChanged, this, &ScanCheckModel::FollowParts);
  connect(session_, &SessionModel::depthChanged, this, &ScanCheckModel::FollowParts);
}

QString ScanCheckModel::Sentence() const {
  switch (state_) {
    case State::kNoScan:
      return tr("Self-check: no scan yet");
    case State::kNotChecked:
      return tr("Self-check: this scan was not checked");
    case State::kChecking:
      return tr("Self-check: checking the scan …");
    case State::kFailed:
      return tr("Self-check: %1").arg(failure_);
    case State::kChecked:
      break;
  }
  if (TogetherIsGraver())
    return tr("%1 scans together: %2")
        .arg(together_->scans)
        .arg(QString::fromStdString(together_->check.advice));
  QString advice = QString::fromStdString(check_->advice);
  if (!advice.isEmpty()) advice[0] = advice[0].toUpper();
  return advice;
}

bool ScanCheckModel::TogetherIsGraver() const {
  return check_ && together_ && together_->check.light >= CheckLight::kAmber &&
         together_->check.light > check_->light;
}

CheckLight ScanCheckModel::Light() const {
  if (TogetherIsGraver()) return together_->check.light;
  return check_ ? check_->light : CheckLight::kNotSeen;
}

void ScanCheckModel::Set(State state) {
  state_ = state;
  if (state != State::kChecked) {
    check_.reset();
    together_.reset();
  }
  Q_EMIT changed();
}

void ScanCheckModel::SetChecked(KeptCheck check) {
  check_ = std::move(check);
  if (check_->scan_uuid != scan_of_before_) of_mission_.push_back(*check_);
  Gather();
  Set(State::kChecked);
}

void ScanCheckModel::Gather() {
  together_.reset();
  if (scan_ && check_) together_ = GatherChecks(of_mission_, scan_->rig);
}

void ScanCheckModel::BeginMission(const std::string& scan_of_before) {
  scan_of_before_ = scan_of_before;
  of_mission_.clear();
  Gather();
  Q_EMIT changed();
}

void ScanCheckModel::AddKept(const std::vector<KeptCheck>& checks) {
  of_mission_.insert(of_mission_.end(), checks.begin(), checks.end());
  Gather();
  Q_EMIT changed();
}

void ScanCheckModel::FollowScan() {
  const auto& scan = session_->CurrentScan();
  if (scan == scan_) return;
  const bool shown_anew = scan && IsOnScreen(*scan);
  scan_ = scan;
  if (shown_anew) return;
  runner_.cancel();
  Set(scan_ ? State::kNotChecked : State::kNoScan);
  FollowParts();
}

bool ScanCheckModel::IsOnScreen(const Scan& scan) const {
  // Late lines make another scan of it.
  return scan_ && scan_->uuid == scan.uuid && scan_->lines.size() == scan.lines.size();
}

void ScanCheckModel::FollowParts() {
  if (!automatic_ || state_ != State::kNotChecked) return;
  // The operator waits for the depth map, and for nothing here.
  if (session_->Depth() || session_->ImageIndex() < 0) check();
}

std::vector<DetectionRecord> ScanCheckModel::AcceptedRecords() const {
  std::vector<DetectionRecord> records;
  for (const FoundObject& object : session_->Objects()) {
    if (object.decision != Decision::kAccepted || object.scan_uuid != scan_->uuid) continue;
    DetectionRecord record = RecordOf(object, {});
    record.decision = object.decision;
    record.name = object.name.toStdString();
    records.push_back(std::move(record));
  }
  return records;
}

void ScanCheckModel::check() {
  if (!scan_ || !session_->Cloud() || session_->Part().lines > 0) return;
  CheckJob job{scan_, session_->Cloud(), session_->ImageIndex(), {}, AcceptedRecords()};
  if (session_->Depth()) job.options.depth = session_->Depth()->options;
  runner_.Run<KeptCheck>(
      tr("Checking the scan"),
      [job = std::move(job)](const RunContext& context) {
        return AfterAllOthers<KeptCheck>(job, context);
      },
      [this, scan = scan_](Result<KeptCheck> check) {
        if (!IsOnScreen(*scan)) return;
        if (!check) {
          failure_ = check.error().code == ErrorCode::kCancelled
                         ? tr("cancelled; a click on the lamp has a button that checks again")
                         : QString::fromStdString(check.error().message);
          Set(State::kFailed);
          return;
        }
        SetChecked(std::move(*check));
        Q_EMIT checked(*check_);
      });
  Set(State::kChecking);
}

void ScanCheckModel::ShowKept(const KeptCheck& check) {
  if (!scan_ || scan_->uuid != check.scan_uuid || state_ == State::kChecking) return;
  SetChecked(check);
}

}  // namespace foresight
