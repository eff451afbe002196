#include "ui/panels/scan_list.h"

#include <QDateTime>
#include <QListWidget>
#include <QPixmap>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "core/geometry/angles.h"
#include "core/sensor/scan.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {

QString TextFor(const ScanSummary& scan) {
  const QDateTime begin = QDateTime::fromMSecsSinceEpoch(scan.begin_utc_ns / 1'000'000);
  if (scan.imported) {
    QString text = ScanList::tr("%1\n%2, %3 lines")
                       .arg(begin.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")),
                            QString::fromStdString(scan.source))
                       .arg(scan.lines);
    if (scan.objects > 0) text += ScanList::tr(", objects: %1").arg(scan.objects);
    return text;
  }
  if (scan.state == ScanState::kRunning) {
    // Its first line says when it began, and may be yet to come.
    return ScanList::tr("Now\n%2° to %3°, %4 °/s\n%1")
        .arg(QString::fromUtf8(ToString(scan.state)))
        .arg(DegreesFromRadians(scan.plan.from_rad), 0, 'f', 0)
        .arg(DegreesFromRadians(scan.plan.to_rad), 0, 'f', 0)
        .arg(DegreesFromRadians(scan.plan.speed_rad_s), 0, 'f', 1);
  }
  QString text = ScanList::tr("%1\n%3° to %4°, %5 °/s, %6 lines\n%2")
                     .arg(begin.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")),
                          QString::fromUtf8(ToString(scan.state)))
                     .arg(DegreesFromRadians(scan.plan.from_rad), 0, 'f', 0)
                     .arg(DegreesFromRadians(scan.plan.to_rad), 0, 'f', 0)
                     .arg(DegreesFromRadians(scan.plan.speed_rad_s), 0, 'f', 1)
                     .arg(scan.lines);
  if (scan.objects > 0) text += ScanList::tr(", objects: %1").arg(scan.objects);
  return text;
}

QIcon IconFor(const ScanSummary& scan) {
  QPixmap pixmap;
  if (!scan.thumbnail.empty())
    pixmap.loadFromData(reinterpret_cast<const uchar*>(scan.thumbnail.data()),
                        static_cast<uint>(scan.thumbnail.size()));
  if (pixmap.isNull()) pixmap = EmptyThumbnail();
  return QIcon(pixmap);
}

namespace {

bool LooksSame(const ScanSummary& a, const ScanSummary& b) {
  return a.uuid == b.uuid && a.state == b.state && a.lines == b.lines && a.objects == b.objects &&
         a.thumbnail.size() == b.thumbnail.size();
}

}  // namespace

ScanList::ScanList(QWidget* parent) : QWidget(parent), list_(new QListWidget) {
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setIconSize(kThumbnailSize);
  list_->setTextElideMode(Qt::ElideRight);
  list_->setAccessibleName(tr("Scans of the mission"));
  list_->setMinimumHeight(60);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(list_);
  connect(list_, &QListWidget::itemClicked, this,
          [this](const QListWidgetItem* item) { Q_EMIT chosen(list_->row(item)); });
  connect(list_, &QListWidget::itemActivated, this,
          [this](const QListWidgetItem* item) { Q_EMIT chosen(list_->row(item)); });
}

void ScanList::Show(const std::vector<ScanSummary>& scans, int chosen_row) {
  const QSignalBlocker quiet(list_);
  const bool grew = scans.size() > scans_.size();
  while (list_->count() > static_cast<int>(scans.size()))
    delete list_->takeItem(list_->count() - 1);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const int row = static_cast<int>(i);
    const bool there = row < list_->count();
    if (there && i < scans_.size() && LooksSame(scans[i], scans_[i])) continue;
    if (!there) list_->addItem(new QListWidgetItem);
    QListWidgetItem* item = list_->item(row);
    item->setText(TextFor(scans[i]));
    item->setIcon(IconFor(scans[i]));
    item->setToolTip(QString::fromStdString(scans[i].reason));
  }
  scans_ = scans;
  list_->setCurrentRow(chosen_row);
  if (grew && chosen_row < 0) list_->scrollToBottom();
}

int ScanList::Count() const {
  return list_->count();
}

QString ScanList::TextOf(int row) const {
  return list_->item(row)->text();
}

}  // namespace foresight
