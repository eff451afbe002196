#include "ui/panels/mission_panel.h"

#include <QDateTime>
#include <QFileInfo>
#include <QLabel>
#include <QListWidget>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace foresight {
namespace {

QString TextOf(const ScanSummary& scan) {
  const QDateTime start = QDateTime::fromMSecsSinceEpoch(scan.start_utc_ns / 1'000'000);
  return MissionPanel::tr("%1\n%2 lines, %3")
      .arg(start.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")))
      .arg(scan.lines)
      .arg(QString::fromUtf8(ToString(scan.state)));
}

}  // namespace

MissionPanel::MissionPanel(MissionViewModel* mission, QWidget* parent)
    : QWidget(parent), mission_(mission), path_(new QLabel), scans_(new QListWidget) {
  path_->setWordWrap(true);
  path_->setObjectName(QStringLiteral("faint"));
  scans_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scans_->setAccessibleName(tr("Scans of the mission"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 12, 12, 12);
  layout->setSpacing(8);
  layout->addWidget(path_);
  layout->addWidget(scans_, 1);
  layout->addStretch();
  connect(mission_, &MissionViewModel::changed, this, &MissionPanel::ShowMission);
  connect(scans_, &QListWidget::currentRowChanged, mission_, &MissionViewModel::showScan);
  ShowMission();
}

void MissionPanel::ShowMission() {
  const int unsaved = mission_->UnsavedScans();
  QString text = mission_->Path().isEmpty()
                     ? tr("No mission file. Scans are kept in memory until you save them (Ctrl+S).")
                     : QFileInfo(mission_->Path()).fileName();
  if (unsaved > 0) text += tr("\nNot saved yet: %1").arg(unsaved);
  path_->setText(text);
  path_->setToolTip(mission_->Path());

  const QSignalBlocker blocker(scans_);
  if (scans_->count() != static_cast<int>(mission_->Scans().size())) {
    scans_->clear();
    for (const ScanSummary& scan : mission_->Scans()) scans_->addItem(TextOf(scan));
  }
  scans_->setCurrentRow(mission_->ScanIndex());
  scans_->setVisible(scans_->count() > 0);
}

}  // namespace foresight
