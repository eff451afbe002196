#pragma once

#include <QTreeView>

#include "ui/viewmodels/review_view_model.h"

namespace foresight {

class OpenMissionsItems;

/// The missions that are open for review, each with its scans: thumbnail, time, scope, state,
/// number of objects. Thumbnails are decoded when they come into sight.
class OpenMissions : public QTreeView {
  Q_OBJECT

 public:
  explicit OpenMissions(ReviewViewModel* review, QWidget* parent = nullptr);

  int MissionCount() const;
  int ScanCount(int mission) const;
  QString TextOf(int mission, int scan = -1) const;
  /// Where a row is drawn.
  QRect RectOf(int mission, int scan = -1) const;
  /// How many thumbnails were decoded so far.
  int DecodedThumbnails() const;

 private:
  void ShowMissions();
  void ShowChosen();
  void ShowMenu(const QPoint& point);

  ReviewViewModel* review_;
  OpenMissionsItems* items_;
};

}  // namespace foresight
