#include "ui/panels/head_device_rows.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>

#include "ui/panels/device_lamps.h"

namespace foresight {
HeadDeviceRows::HeadDeviceRows(HeadViewModel* head, QWidget* parent)
    : QWidget(parent), head_(head) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setColumnStretch(1, 1);
  int at = 0;
  rows_.resize(static_cast<std::size_t>(head_->Devices().size()));
  for (Row& row : rows_) {
    row = {new QLabel, new QLabel, new QLabel, {}};
    row.detail->setWordWrap(true);
    grid->addWidget(row.lamp, at, 0, Qt::AlignTop);
    grid->addWidget(row.title, at, 1);
    grid->addWidget(row.detail, at + 1, 1);
    at += 2;
  }
  connect(head_, &HeadViewModel::statusChanged, this, &HeadDeviceRows::Show);
  Show();
}

bool HeadDeviceRows::event(QEvent* event) {
  // Asked for only now: to hash the rig at every status would be work for nobody.
  if (event->type() == QEvent::ToolTip) setToolTip(head_->RigText());
  return QWidget::event(event);
}

void HeadDeviceRows::Show() {
  const QVector<DeviceRow>& devices = head_->Devices();
  for (int i = 0; i < devices.size(); ++i) {
    Row& row = rows_[static_cast<std::size_t>(i)];
    if (row.shown != devices[i].lamp) row.lamp->setPixmap(LampPixmap(devices[i].lamp));
    row.shown = devices[i].lamp;
    row.title->setText(tr("%1: %2").arg(devices[i].name, devices[i].state));
    // Out of sight it would change once a second for nobody.
    if (!row.detail->isVisible() || !row.detail->visibleRegion().isEmpty())
      row.detail->setText(devices[i].detail);
    row.detail->setVisible(!devices[i].detail.isEmpty());
  }
}

}  // namespace foresight
