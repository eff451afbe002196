#pragma once

#include <QMainWindow>

#include "app/workstation/workbench.h"

namespace ads {
class CDockManager;
class CDockWidget;
}  // namespace ads

class QSettings;

namespace foresight {

class Actions;
class CloudPane;
class DepthPane;
class ImagePane;
class NoticeStrip;

/// Places docks and actions; everything else lives in the view-models, views and panels.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(Workbench* bench, QWidget* parent = nullptr);

  ImagePane* Image() { return image_; }
  DepthPane* Depth() { return depth_; }
  CloudPane* Cloud() { return cloud_; }
  NoticeStrip* Notices() { return notices_; }

  /// Where the panes are and how large the window is; kept from one run to the next.
  void SaveLayout(QSettings* settings) const;
  /// A layout of another version of the program is left alone.
  void RestoreLayout(const QSettings& settings);
  void ResetLayout();

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  void BuildBars();
  void BuildCentre();
  void BuildDocks();
  ads::CDockWidget* Dock(const char* name, const QString& title, QWidget* content);
  void BindViews();
  void ChooseFile(bool save, const QString& title, const QString& filter, const QString& suffix,
                  const std::function<void(QString)>& chosen);

  Workbench* bench_;
  Actions* actions_;
  ImagePane* image_;
  DepthPane* depth_;
  CloudPane* cloud_;
  NoticeStrip* notices_;
  ads::CDockManager* docks_;
  QMenu* view_menu_;
  QByteArray first_layout_;
  bool close_was_asked_ = false;
};

}  // namespace foresight
