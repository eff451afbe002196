#pragma once

#include <QObject>
#include <memory>
#include <thread>

#include "app/workstation/desk.h"
#include "core/depth/lab_image.h"
#include "ui/viewmodels/camera_calibration_model.h"
#include "ui/viewmodels/chain_calibration_model.h"
#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/head_view_model.h"
#include "ui/viewmodels/import_view_model.h"
#include "ui/viewmodels/link_view_model.h"
#include "ui/viewmodels/live_check_flow.h"
#include "ui/viewmodels/live_depth_view_model.h"
#include "ui/viewmodels/log_model.h"
#include "ui/viewmodels/mission_search_model.h"
#include "ui/viewmodels/recording_view_model.h"
#include "ui/viewmodels/region_first.h"
#include "ui/viewmodels/replay_model.h"
#include "ui/viewmodels/review_check_flow.h"
#include "ui/viewmodels/review_view_model.h"
#include "ui/viewmodels/robot_fit_model.h"
#include "ui/viewmodels/scan_flow.h"
#include "ui/viewmodels/send_pose_model.h"
#include "ui/viewmodels/side_results_model.h"
#include "ui/viewmodels/timeline_model.h"

namespace foresight {

/// All view-models of the workstation, wired to each other and to one head. It has two documents:
/// the live one, fed by the head and always recorded, and one for review. The window shows one.
class Workbench : public QObject {
  Q_OBJECT

 public:
  /// `mode` is kLive or kSimulation; `stand` is a calibration stand that moves by itself, or
  /// nullptr.
  Workbench(std::shared_ptr<SensorHead> sensor_head, SessionMode mode,
            std::shared_ptr<MovingStand> stand = nullptr);

  TaskQueue tasks;
  LogModel log;
  HeadViewModel head;
  Desk live;
  Desk review;
  RecordingViewModel recording;
  ReviewViewModel reviewer;
  ImportViewModel importer;
  TimelineModel timeline;
  ReplayModel replay;
  LiveDepthViewModel replay_depth;
  MissionSearchModel search;
  SideResultsModel side_results;
  LiveCheckFlow live_check;
  ReviewCheckFlow review_check;
  ScanFlow flow;
  LiveDepthViewModel live_depth;
  CameraCalibrationModel camera_calibration;
  ChainCalibrationModel head_calibration;
  /// Of a head that is elsewhere; nullptr where it is in this process.
  std::unique_ptr<LinkViewModel> link;
  std::unique_ptr<RegionFirst> region_first;
  std::unique_ptr<SendPoseModel> send_pose;
  std::unique_ptr<RobotFitModel> robot_fit;
  CommandTable commands;

  /// Whether the window shows the document for review.
  bool ShowsReview() const { return shows_review_; }
  Desk& Shown() { return shows_review_ ? review : live; }
  /// The file of the mission that is shown; empty when there is none.
  QString ShownMission() const { return shows_review_ ? reviewer.Path() : recording.Path(); }
  /// Nothing runs and the last scan has its depth.
  bool Idle();

 public Q_SLOTS:
  void showReview();
  void backToLive();

 Q_SIGNALS:
  void shownChanged();

 private:
  void ShowOpened();
  void ConnectLink(const std::shared_ptr<SensorHead>& sensor_head);
  void KeepCommandsCurrent();

  bool shows_review_ = false;
  QString opened_beside_;               ///< mission that a running scan stays on the screen for
  std::jthread preparing_{PrepareLab};  ///< what the first depth map would wait for
};

}  // namespace foresight
