#pragma once

#include <QWidget>

#include "ui/panels/open_missions.h"
#include "ui/panels/scan_list.h"
#include "ui/viewmodels/command_table.h"
#include "ui/viewmodels/recording_view_model.h"
#include "ui/viewmodels/review_view_model.h"

class QLabel;
class QStackedWidget;

namespace foresight {

/// The mission file of the document that is shown and its scans: the one that is being recorded, or
/// those that are open for review. A scan of the running mission is looked at in the review.
class MissionPanel : public QWidget {
  Q_OBJECT

 public:
  MissionPanel(RecordingViewModel* recording, ReviewViewModel* review, CommandTable* commands,
               QWidget* parent = nullptr);

  void ShowDocument(bool review);
  ScanList* Recorded() { return recorded_; }
  OpenMissions* Reviewed() { return reviewed_; }

 private:
  QWidget* BuildLivePage();
  QWidget* BuildReviewPage(CommandTable* commands);
  void ShowRecording();
  void ShowReview();

  RecordingViewModel* recording_;
  ReviewViewModel* review_;
  QStackedWidget* pages_;
  QLabel* recorded_path_;
  QLabel* waiting_;
  ScanList* recorded_;
  QLabel* reviewed_path_;
  OpenMissions* reviewed_;
};

}  // namespace foresight
