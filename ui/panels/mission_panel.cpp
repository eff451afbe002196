#include "ui/panels/mission_panel.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "ui/panels/command_button.h"

namespace foresight {
namespace {

QLabel* Line(const char* name) {
  auto* label = new QLabel;
  label->setWordWrap(true);
  label->setObjectName(QString::fromLatin1(name));
  label->setMinimumWidth(0);
  return label;
}

QWidget* Page(const std::initializer_list<QWidget*>& rows) {
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(12, 8, 12, 8);
  layout->setSpacing(6);
  for (QWidget* row : rows) layout->addWidget(row);
  return page;
}

}  // namespace

MissionPanel::MissionPanel(RecordingViewModel* recording, ReviewViewModel* review,
                           CommandTable* commands, QWidget* parent)
    : QWidget(parent), recording_(recording), review_(review), pages_(new QStackedWidget) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(pages_);
  pages_->addWidget(BuildLivePage());
  pages_->addWidget(BuildReviewPage(commands));
  connect(recording_, &RecordingViewModel::changed, this, &MissionPanel::ShowRecording);
  connect(review_, &ReviewViewModel::changed, this, &MissionPanel::ShowReview);
  ShowRecording();
  ShowReview();
}

QWidget* MissionPanel::BuildLivePage() {
  recorded_path_ = Line("faint");
  waiting_ = Line("");
  recorded_ = new ScanList;
  connect(recorded_, &ScanList::chosen, this, [this](int index) {
    const auto& scans = recording_->Scans();
    if (index >= 0 && index < static_cast<int>(scans.size()))
      review_->Open(recording_->Path(), scans[static_cast<std::size_t>(index)].uuid);
  });
  return Page({recorded_path_, waiting_, recorded_});
}

QWidget* MissionPanel::BuildReviewPage(CommandTable* commands) {
  reviewed_path_ = Line("faint");
  auto* back = new QPushButton(tr("Back to live"));
  BindButton(back, commands, "view.live");
  auto* close = new QPushButton(tr("Close"));
  BindButton(close, commands, "review.close");
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(back);
  row->addWidget(close);
  reviewed_ = new OpenMissions(review_);
  return Page({reviewed_path_, buttons, reviewed_});
}

void MissionPanel::ShowDocument(bool review) {
  pages_->setCurrentIndex(review ? 1 : 0);
}

void MissionPanel::ShowRecording() {
  recorded_path_->setText(
      recording_->FileHasMoved()
          ? tr("Moved or deleted: %1").arg(QFileInfo(recording_->Path()).fileName())
      : recording_->Recording()
          ? tr("Recording into %1").arg(QFileInfo(recording_->Path()).fileName())
          : tr("Not recorded: choose a mission file (Ctrl+Shift+S)."));
  recorded_path_->setToolTip(recording_->Path());
  waiting_->setText(tr("In memory only: %1").arg(recording_->Waiting()));
  waiting_->setVisible(recording_->Waiting() > 0 && !recording_->Busy());
  recorded_->Show(recording_->Scans(), -1);
}

void MissionPanel::ShowReview() {
  reviewed_path_->setText(review_->Path().isEmpty()
                              ? tr("No mission is open for review.")
                              : tr("Review of %1").arg(QFileInfo(review_->Path()).fileName()));
  reviewed_path_->setToolTip(review_->Path());
}

}  // namespace foresight
