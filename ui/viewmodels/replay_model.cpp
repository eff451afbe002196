#include "ui/viewmodels/replay_model.h"

#include <QScopedValueRollback>
#include <algorithm>

namespace foresight {
namespace {

constexpr int kStep_ms = 40;

/// When the depth of each image of the scan was computed first.
std::map<int, std::int64_t> DepthTimes(const std::vector<DepthRecord>& records,
                                       const std::string& scan_uuid) {
  std::map<int, std::int64_t> times;
  for (const DepthRecord& record : records) {
    if (record.scan_uuid != scan_uuid) continue;
    const auto [at, added] = times.emplace(static_cast<int>(record.image_position), record.utc_ns);
    if (!added) at->second = std::min(at->second, record.utc_ns);
  }
  return times;
}

}  // namespace

ReplayModel::ReplayModel(ReviewViewModel* review, SessionModel* session, DepthViewModel* depth,
                         TimelineModel* timeline, QObject* parent)
    : QObject(parent), review_(review), session_(session), depth_(depth), timeline_(timeline) {
  connect(review_, &ReviewViewModel::opened, this, &ReplayModel::FollowReview);
  connect(review_, &ReviewViewModel::changed, this, [this] {
    if (!review_->File()) Forget();
  });
  connect(timeline_, &TimelineModel::changed, this, [this] {
    if (!active_) FollowReview();
  });
  connect(session_, &SessionModel::imageChanged, this, [this] {
    // The operator chose another image; the session drops the depth of the last one first.
    if (active_ && !showing_)
      QTimer::singleShot(0, this, [this] {
        if (active_) ShowDepth();
      });
  });
  connect(session_, &SessionModel::objectAdded, this, &ReplayModel::AddObject);
  connect(depth_, &DepthViewModel::computed, this, &ReplayModel::KeepDepth);
  connect(&timer_, &QTimer::timeout, this,
          [this] { Advance(1e-9 * static_cast<double>(since_.nsecsElapsed())); });
}

QString ReplayModel::WhyNot() const {
  if (!review_->File()) return tr("No mission is open for review. Open one (Ctrl+O).");
  if (!timeline_->Timeline()) return tr("The timeline is not read yet.");
  return {};
}

void ReplayModel::SetSpeed(double speed) {
  speed = std::clamp(speed, kSlowest, kFastest);
  if (speed == speed_) return;
  speed_ = speed;
  Q_EMIT changed();
}

void ReplayModel::toggleSkipsIdle() {
  skips_idle_ = !skips_idle_;
  Q_EMIT changed();
}

/// The moment itself or, where it lies in time that is skipped, the end of that.
std::int64_t ReplayModel::AfterIdle(std::int64_t utc_ns) const {
  constexpr auto kLinger_ns = static_cast<std::int64_t>(1e9 * kLinger_s);
  constexpr auto kLead_ns = static_cast<std::int64_t>(1e9 * kLead_s);
  const TimelineMarks& marks = timeline_->Marks();
  const std::int64_t last = marks.PreviousTime(utc_ns + 1);
  const std::int64_t next = marks.NextTime(utc_ns);
  if (utc_ns - last < kLinger_ns || next - utc_ns <= kLead_ns) return utc_ns;
  for (const TimelineEntry& entry : timeline_->Timeline()->entries)
    if (entry.lane == TimelineLane::kScans && entry.begin_utc_ns <= utc_ns &&
        utc_ns < entry.end_utc_ns)
      return utc_ns;
  return next - kLead_ns;
}

void ReplayModel::Forget() {
  runner_.cancel();
  timer_.stop();
  active_ = playing_ = false;
  Q_EMIT sweepBroken();
  depth_->SetAutomatic(true);
  scan_.reset();
  scan_index_ = -1;
  now_utc_ns_ = 0;
  Q_EMIT moved();
  Q_EMIT changed();
}

/// A scan was asked for: all of it is shown, and the play head stands at its end.
void ReplayModel::FollowReview() {
  if (!review_->File() || review_->ScanIndex() < 0) return;
  if (active_ || scan_) {
    Forget();
    if (session_->CurrentScan() && !session_->Depth()) depth_->compute();
  }
  scan_index_ = review_->ScanIndex();
  const ScanSummary& summary = review_->Scans()[static_cast<std::size_t>(scan_index_)];
  now_utc_ns_ = summary.begin_utc_ns;
  if (timeline_->Timeline())
    for (const TimelineEntry& entry : timeline_->Timeline()->entries)
      if (entry.lane == TimelineLane::kScans && entry.scan_uuid == summary.uuid)
        now_utc_ns_ = entry.end_utc_ns;
  Q_EMIT moved();
  Q_EMIT changed();
}

int ReplayModel::ScanAt(std::int64_t utc_ns) const {
  const std::vector<ScanSummary>& scans = review_->Scans();
  int found = -1;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (scans[i].begin_utc_ns <= utc_ns &&
        (found < 0 || scans[i].begin_utc_ns >= scans[static_cast<std::size_t>(found)].begin_utc_ns))
      found = static_cast<int>(i);
  return found;
}

void ReplayModel::Enter() {
  if (active_) return;
  active_ = true;
  depth_->SetAutomatic(false);
  Q_EMIT changed();
}

void ReplayModel::play() {
  if (!WhyNot().isEmpty() || playing_) return;
  if (!active_ && scan_index_ >= 0)
    now_utc_ns_ = review_->Scans()[static_cast<std::size_t>(scan_index_)].begin_utc_ns;
  playing_ = true;
  since_.start();
  timer_.start(kStep_ms);
  Enter();
  SeekTo(now_utc_ns_);
  Q_EMIT changed();
}

void ReplayModel::pause() {
  if (!playing_) return;
  playing_ = false;
  timer_.stop();
  Q_EMIT changed();
}

void ReplayModel::Advance(double seconds) {
  since_.start();
  if (!playing_ || Loading()) return;
  const auto step = static_cast<std::int64_t>(1e9 * speed_ * seconds);
  std::int64_t next = now_utc_ns_ + step;
  if (skips_idle_) next = AfterIdle(next);
  // Not past the begin of a scan: it is loaded first.
  for (const ScanSummary& scan : review_->Scans())
    if (scan.begin_utc_ns > now_utc_ns_) next = std::min(next, scan.begin_utc_ns);
  SeekTo(next);
  if (now_utc_ns_ == timeline_->Timeline()->end_utc_ns && !Loading()) leave();
}

void ReplayModel::SeekTo(std::int64_t utc_ns) {
  if (!WhyNot().isEmpty()) return;
  const MissionTimeline& timeline = *timeline_->Timeline();
  Enter();
  now_utc_ns_ = std::clamp(utc_ns, timeline.begin_utc_ns, timeline.end_utc_ns);
  ShowMoment();
  Q_EMIT moved();
}

void ReplayModel::nextEvent() {
  if (WhyNot().isEmpty()) SeekTo(timeline_->Marks().NextTime(now_utc_ns_));
}

void ReplayModel::previousEvent() {
  if (WhyNot().isEmpty()) SeekTo(timeline_->Marks().PreviousTime(now_utc_ns_));
}

void ReplayModel::ShowMoment() {
  const int index = ScanAt(now_utc_ns_);
  if (index < 0) {  // before the first scan
    runner_.cancel();
    scan_.reset();
    scan_index_ = -1;
    const QScopedValueRollback<bool> showing(showing_, true);
    if (session_->CurrentScan() || !session_->ExpectsScan()) session_->ExpectScan();
    session_->ShowObjects({});
    return;
  }
  if (!scan_ || scan_->Whole()->uuid != review_->Scans()[static_cast<std::size_t>(index)].uuid) {
    if (!Loading() || index != scan_index_) LoadScan(index);
    return;
  }
  scan_->IsWhole(now_utc_ns_) ? ShowWhole() : ShowPart();
}

void ReplayModel::LoadScan(int index) {
  scan_index_ = index;
  const ScanSummary& summary = review_->Scans()[static_cast<std::size_t>(index)];
  // What the session shows already is not read again.
  const bool shown = session_->CurrentScan() && session_->CurrentScan()->uuid == summary.uuid;
  ReplayScan known;
  if (shown) {
    known.reviewed.scan = session_->CurrentScan();
    known.cloud = session_->Cloud();
    if (session_->Depth()) known.depths[session_->ImageIndex()] = session_->Depth();
  }
  known.begin_utc_ns = summary.begin_utc_ns;
  known.end_utc_ns = summary.begin_utc_ns;
  for (const TimelineEntry& entry : timeline_->Timeline()->entries)
    if (entry.lane == TimelineLane::kScans && entry.scan_uuid == summary.uuid)
      known.end_utc_ns = entry.end_utc_ns;
  runner_.Run<ReplayScan>(
      tr("Loading the scan"),
      [known = std::move(known), mission = review_->File(),
       summary](const RunContext& context) -> Result<ReplayScan> {
        ReplayScan loaded = known;
        FORESIGHT_TRY(loaded.reviewed,
                      LoadReviewedScan(*mission, ReviewFolder(), summary, known.reviewed.scan));
        FORESIGHT_TRY(const std::vector<DepthRecord> depths, mission->ListDepths(summary.id));
        loaded.depth_utc_ns = DepthTimes(depths, summary.uuid);
        if (loaded.cloud) return loaded;
        // A scan without a return has no points, and is shown without.
        auto cloud = RegisterScan(*loaded.Whole(), context);
        if (cloud) loaded.cloud = std::make_shared<const RegisteredScan>(std::move(*cloud));
        return loaded;
      },
      [this, index](Result<ReplayScan> loaded) {
        if (!active_ || index != scan_index_) return;
        if (!loaded) {
          pause();
          if (loaded.error().code != ErrorCode::kCancelled)
            session_->Report(NoticeOf(tr("Loading the scan"), loaded.error()));
          return;
        }
        scan_ = std::move(*loaded);
        object_states_.clear();
        review_->Follow(index, scan_->reviewed.Objects());
        since_.start();
        ShowMoment();
        Q_EMIT changed();
      });
}

void ReplayModel::ShowPart() {
  const QScopedValueRollback<bool> showing(showing_, true);
  const Scan& whole = *scan_->Whole();
  const int lines = scan_->LinesAt(now_utc_ns_);
  const int images = scan_->ImagesAt(now_utc_ns_);
  const auto& arriving = session_->ShownScan();
  const bool fresh = session_->CurrentScan() || !session_->ExpectsScan() ||
                     (arriving && arriving->uuid != whole.uuid);
  if (fresh) session_->ExpectScan();
  const auto& before = session_->ShownScan();
  if (fresh || !before || before->lines.size() > static_cast<std::size_t>(lines))
    Q_EMIT sweepBroken();
  if (!before || before->lines.size() != static_cast<std::size_t>(lines) ||
      before->frames.size() != static_cast<std::size_t>(images)) {
    const auto part = scan_->Part(lines, images);
    session_->SetArriving(part);
    session_->SetCloud(scan_->CloudOf(lines), whole.rig,
                       {part, lines, static_cast<int>(whole.lines.size())});
  }
  if (const auto states = scan_->ObjectStatesAt(now_utc_ns_); fresh || states != object_states_) {
    object_states_ = states;
    ShowObjects(scan_->ObjectsAt(now_utc_ns_));
  }
}

void ReplayModel::ShowWhole() {
  const bool fresh = session_->CurrentScan() != scan_->Whole();
  if (fresh) {
    const QScopedValueRollback<bool> showing(showing_, true);
    depth_asked_for_ = -1;
    Q_EMIT sweepBroken();
    session_->SetScan(scan_->Whole());
    if (scan_->cloud) session_->SetCloud(scan_->cloud, scan_->Whole()->rig);
  }
  ShowDepth();
  if (const auto states = scan_->ObjectStatesAt(now_utc_ns_); fresh || states != object_states_) {
    object_states_ = states;
    ShowObjects(scan_->ObjectsAt(now_utc_ns_));
  }
}

void ReplayModel::ShowDepth() {
  if (!scan_ || session_->CurrentScan() != scan_->Whole()) return;
  const int image = session_->ImageIndex();
  const bool due = scan_->HasDepthAt(image, now_utc_ns_);
  if (!due) {
    depth_asked_for_ = -1;
    depth_->cancel();
    if (session_->Depth()) session_->SetDepth(nullptr);
    return;
  }
  // Where it failed or was cancelled it is not tried again at every look.
  if (session_->Depth() || depth_asked_for_ == image) return;
  depth_asked_for_ = image;
  const auto known = scan_->depths.find(image);
  if (known != scan_->depths.end())
    depth_->ShowAgain(known->second);
  else if (scan_->cloud)
    depth_->compute();
}

void ReplayModel::KeepDepth() {
  if (scan_ && session_->CurrentScan() == scan_->Whole())
    scan_->depths[session_->ImageIndex()] = session_->Depth();
}

void ReplayModel::ShowObjects(std::vector<FoundObject> objects) {
  const FoundObject* selected = session_->Selected();
  const std::string uuid = selected != nullptr ? selected->uuid : std::string();
  session_->ShowObjects(std::move(objects));
  for (std::size_t i = 0; i < session_->Objects().size(); ++i)
    if (session_->Objects()[i].uuid == uuid) session_->SelectObject(static_cast<int>(i));
}

/// What is found during a replay belongs to the moment in which it was found.
void ReplayModel::AddObject(const FoundObject& object) {
  if (!active_ || !scan_) return;
  ReviewedObject added;
  added.object = object;
  added.found_utc_ns = now_utc_ns_;
  scan_->reviewed.objects.push_back(std::move(added));
  object_states_ = scan_->ObjectStatesAt(now_utc_ns_);
}

void ReplayModel::leave() {
  if (!active_) return;
  pause();
  runner_.cancel();
  active_ = false;
  Q_EMIT sweepBroken();
  depth_->SetAutomatic(true);
  if (scan_) {
    now_utc_ns_ = scan_->end_utc_ns;
    scan_index_ = review_->ScanIndex();
    if (session_->CurrentScan() != scan_->Whole()) {
      const QScopedValueRollback<bool> showing(showing_, true);
      depth_->SetAutomatic(false);
      session_->SetScan(scan_->Whole());
      if (scan_->cloud) session_->SetCloud(scan_->cloud, scan_->Whole()->rig);
      depth_->SetAutomatic(true);
    }
    if (!session_->Depth() && session_->ImageIndex() >= 0) {
      const auto known = scan_->depths.find(session_->ImageIndex());
      known != scan_->depths.end() ? depth_->ShowAgain(known->second) : depth_->compute();
    }
    ShowObjects(scan_->reviewed.Objects());
    scan_.reset();
  } else if (!review_->Scans().empty()) {
    review_->showScan(std::max(0, scan_index_));
  }
  Q_EMIT moved();
  Q_EMIT changed();
}

}  // namespace foresight
