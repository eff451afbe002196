#pragma once

#include <QMainWindow>
#include <functional>

#include "app/workstation/file_choice.h"
#include "app/workstation/workbench.h"

namespace ads {
class CDockAreaWidget;
class CDockManager;
class CDockWidget;
}  // namespace ads

class QSettings;

namespace foresight {

class Actions;
class CameraCalibrationPanel;
class ChainCalibrationPanel;
class CloudPane;
class ComparisonPane;
class DepthPane;
class DocumentStack;
class HeadStrip;
class ImagePane;
class LogStrip;
class MissionPanel;
class MissionSearchPanel;
class QuitQuestion;
class SideResultsPanel;
class SourceGallery;
class UnsavedQuestion;

/// Places docks, menus and keys; everything else lives in the view-models, views and panels. Shows
/// the live document or the one for review, and says which.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(Workbench* bench, QWidget* parent = nullptr);

  /// The panes of the live document.
  ImagePane* Image() { return image_; }
  DepthPane* Depth() { return depth_; }
  CloudPane* Cloud() { return cloud_; }
  MissionPanel* Mission() { return mission_; }
  MissionSearchPanel* Search() { return search_; }
  LogStrip* Log() { return log_; }
  SourceGallery* Gallery() { return gallery_; }
  SideResultsPanel* SideResults() { return side_results_; }
  /// A and B beside each other; nullptr until it is first asked for.
  ComparisonPane* Comparison() { return comparison_; }
  CameraCalibrationPanel* Calibration() { return calibration_; }
  ChainCalibrationPanel* HeadCalibration() { return head_calibration_; }

  /// Where the panes are and how large the window is; kept from one run to the next.
  /// Of a closed window: as it was.
  void SaveLayout(QSettings* settings) const;
  /// Call it when the window is shown. A layout of another version of the program is left alone.
  void RestoreLayout(const QSettings& settings);
  void ResetLayout();
  /// Also in the middle of a sweep, where the operator would be asked first.
  void CloseUnasked();

 Q_SIGNALS:
  void stayed();  ///< the operator was asked while it closed, and keeps it open

 protected:
  void showEvent(QShowEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  // window_commands.cpp
  void AddFileCommands();
  void AddViewCommands();
  void AddHelpCommands();
  void AddCommandsOfResults();
  void ChooseBundle();
  void ChooseRecordingFile();

  void ShowComparison();
  void BuildMenus();
  void BuildCentre();
  void BuildDocks();
  ads::CDockWidget* Dock(const char* name, const QString& title, QWidget* content);
  DocumentStack* Stack(QWidget* live, std::function<QWidget*(Desk*)> make);
  QWidget* MakeCheckLamp(Desk* desk);
  static void Open(ads::CDockWidget* dock);
  void ShowDocument();
  void ShowTimeline(bool review);
  void PlaceTimeline();
  bool OnLowScreen() const;
  void BringFloatingDocksBack();

  Workbench* bench_;
  FileChoice files_;
  Actions* actions_ = nullptr;
  ImagePane* image_;
  DepthPane* depth_;
  CloudPane* cloud_;
  QuitQuestion* quit_question_;
  UnsavedQuestion* unsaved_question_;
  HeadStrip* strip_ = nullptr;
  LogStrip* log_ = nullptr;
  MissionPanel* mission_ = nullptr;
  MissionSearchPanel* search_ = nullptr;
  SourceGallery* gallery_ = nullptr;
  SideResultsPanel* side_results_ = nullptr;
  ComparisonPane* comparison_ = nullptr;
  CameraCalibrationPanel* calibration_ = nullptr;
  ChainCalibrationPanel* head_calibration_ = nullptr;
  QVector<DocumentStack*> stacks_;
  ads::CDockManager* docks_ = nullptr;
  ads::CDockWidget* cloud_dock_ = nullptr;
  ads::CDockWidget* gallery_dock_ = nullptr;
  ads::CDockWidget* results_dock_ = nullptr;
  ads::CDockWidget* comparison_dock_ = nullptr;
  ads::CDockWidget* options_dock_ = nullptr;
  ads::CDockWidget* notes_dock_ = nullptr;
  ads::CDockWidget* map_dock_ = nullptr;
  ads::CDockWidget* check_dock_ = nullptr;
  ads::CDockWidget* calibration_dock_ = nullptr;
  ads::CDockWidget* head_calibration_dock_ = nullptr;
  ads::CDockWidget* search_dock_ = nullptr;
  ads::CDockWidget* timeline_dock_ = nullptr;
  bool timeline_follows_ = false;  ///< the review is shown, and the timeline with it
  bool timeline_wanted_ = true;    ///< the operator did not close it in a review
  QMenu* view_menu_ = nullptr;
  QByteArray first_layout_;
  QByteArray layout_at_close_;
};

}  // namespace foresight
