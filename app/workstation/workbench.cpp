#include "app/workstation/workbench.h"

#include "app/workstation/commands.h"
#include "app/workstation/review_commands.h"

namespace foresight {

Workbench::Workbench(std::shared_ptr<SensorHead> sensor_head, SessionMode mode,
                     std::shared_ptr<MovingStand> stand)
    : head(sensor_head),
      live(mode, &tasks),
      review(SessionMode::kReplay, &tasks),
      recording(&live.session),
      reviewer(&review.session),
      importer(&review.session),
      timeline(&reviewer, &review.session),
      replay(&reviewer, &review.session, &review.depth, &timeline),
      replay_depth({[this] { return replay.Sweeping(); },
                    [this] { return review.session.ShownScan()->plan; }},
                   &review.session),
      search(&reviewer, &tasks, RecordingViewModel::DefaultFolder()),
      side_results(&reviewer, &review.session, &review.depth, &review.fit, &review.compare),
      live_check(&recording, &live.session, &live.check),
      review_check(&reviewer, &review.session, &review.check),
      flow(&head, &live.session),
      live_depth(&head, &live.session),
      camera_calibration(&head, &live.session),
      head_calibration(&head, &live.session, {}, std::move(stand)) {
  qRegisterMetaType<Notice>("foresight::Notice");
  head.SetRecorderSource([this] { return recording.Recorder(); });
  connect(&head, &HeadViewModel::scanStarted, this, [this] { log.close(kScanTopic); });
  connect(&head, &HeadViewModel::stopReleased, this, [this] { log.close(kStopTopic); });
  connect(&head, &HeadViewModel::settled, &log, &LogModel::close);
  connect(&head, &HeadViewModel::scanStarted, &recording, &RecordingViewModel::refreshList);
  connect(&head, &HeadViewModel::scanEnded, &recording, &RecordingViewModel::keepScan);
  connect(&live.depth, &DepthViewModel::computed, &recording, &RecordingViewModel::keepDepth);
  connect(&live.depth, &DepthViewModel::computed, &tasks, &TaskQueue::GiveMemoryBack);
  live.check.SetAutomatic(true);
  connect(&recording, &RecordingViewModel::allWritten, this,
          [this] { log.close(kRecordingTopic); });
  connect(&recording, &RecordingViewModel::interruptedTaken, this,
          [this] { log.close(kInterruptedTopic); });
  for (SessionModel* session : {&live.session, &review.session}) {
    connect(session, &SessionModel::noticed, &log, &LogModel::add);
    connect(session, &SessionModel::settled, &log, &LogModel::close);
  }
  connect(&log, &LogModel::added, &recording, &RecordingViewModel::keepNotice);
  connect(&reviewer, &ReviewViewModel::opened, this, &Workbench::ShowOpened);
  connect(&reviewer, &ReviewViewModel::notOpened, this, [this] { opened_beside_.clear(); });
  connect(&importer, &ImportViewModel::imported, this, [this](const QString& mission) {
    // Nobody asked for the review at this moment: a running scan stays in sight.
    if (head.Scanning() && !ShowsReview()) opened_beside_ = mission;
    reviewer.Open(mission);
  });
  connect(&reviewer, &ReviewViewModel::opened, this, [this] {
    if (review.map.Mission() != reviewer.Path()) review.map.clear();  // it is of another mission
  });
  connect(&replay, &ReplayModel::sweepBroken, &replay_depth, &LiveDepthViewModel::clear);
  connect(&reviewer, &ReviewViewModel::changed, this, [this] {
    if (reviewer.Missions().empty()) backToLive();  // the last one was closed
  });
  connect(&commands, &CommandTable::refused, this, [this](const QString& text, const QString& why) {
    log.add({Notice::Level::kInfo, tr("%1 is not possible now.").arg(text), why});
  });
  connect(&commands, &CommandTable::ran, &recording, [this](const QString& id) {
    // What is done in a review is no part of the mission that is being recorded.
    if (!id.startsWith(QLatin1String("review."))) recording.keepCommand(id);
  });
  ConnectLink(sensor_head);
  AddCommands(this);
  AddReviewCommands(this);
  KeepCommandsCurrent();
}

void Workbench::ShowOpened() {
  if (opened_beside_ != reviewer.Path()) return showReview();
  opened_beside_.clear();
  log.add({Notice::Level::kInfo, tr("The imported mission is open for review."),
           tr("The running scan stays on the screen; Ctrl+R shows the review.")});
}

void Workbench::ConnectLink(const std::shared_ptr<SensorHead>& sensor_head) {
  if (sensor_head->Link() == nullptr) return;
  link = std::make_unique<LinkViewModel>(sensor_head, &tasks);
  region_first = std::make_unique<RegionFirst>(&head, &live.session, sensor_head->Link());
  send_pose = std::make_unique<SendPoseModel>(sensor_head, &live.session);
  robot_fit = std::make_unique<RobotFitModel>(sensor_head, &live.session, &live.fit, &live.depth);
  connect(link.get(), &LinkViewModel::noticed, &log, &LogModel::add);
  connect(link.get(), &LinkViewModel::scanArrived, &recording, &RecordingViewModel::refreshList);
  connect(link.get(), &LinkViewModel::connectedChanged, &recording, &RecordingViewModel::keepLink);
  recording.keepLink(link->Connected());
}

void Workbench::KeepCommandsCurrent() {
  // The models tell of changes even while they go, when the commands have gone already.
  const auto refresh = [this] { commands.refresh(); };
  connect(&head, &HeadViewModel::statusChanged, &commands, refresh);
  connect(&head, &HeadViewModel::planChanged, &commands, refresh);
  if (send_pose) connect(send_pose.get(), &SendPoseModel::changed, &commands, refresh);
  if (robot_fit) connect(robot_fit.get(), &RobotFitModel::changed, &commands, refresh);
  connect(&recording, &RecordingViewModel::changed, &commands, refresh);
  connect(&reviewer, &ReviewViewModel::changed, &commands, refresh);
  connect(&timeline, &TimelineModel::changed, &commands, refresh);
  connect(&replay, &ReplayModel::changed, &commands, refresh);
  connect(&side_results, &SideResultsModel::changed, &commands, refresh);
  connect(this, &Workbench::shownChanged, &commands, refresh);
  for (Desk* desk : {&live, &review}) {
    connect(&desk->fit, &FitViewModel::changed, &commands, refresh);
    connect(&desk->session, &SessionModel::objectsChanged, &commands, refresh);
    connect(&desk->measure, &MeasureViewModel::changed, &commands, refresh);
    connect(&desk->map, &MapViewModel::changed, &commands, refresh);
    connect(&desk->clip, &ClipBoxModel::changed, &commands, refresh);
    connect(desk->session.Notes(), &NotesModel::changed, &commands, refresh);
    // A click means one thing at a time.
    connect(&desk->measure, &MeasureViewModel::changed, &desk->fit, [desk] {
      if (desk->measure.On() && (desk->fit.Drawing())) desk->fit.leaveTools();
    });
    connect(&desk->fit, &FitViewModel::changed, &desk->measure, [desk] {
      if (desk->fit.Drawing()) desk->measure.leave();
    });
    connect(desk->session.Undo(), &UndoStack::changed, &commands, refresh);
  }
}

bool Workbench::Idle() {
  return !head.Scanning() && tasks.Idle();
}

void Workbench::showReview() {
  if (shows_review_) return;
  shows_review_ = true;
  Q_EMIT shownChanged();
}

void Workbench::backToLive() {
  if (!shows_review_) return;
  shows_review_ = false;
  Q_EMIT shownChanged();
}

}  // namespace foresight
