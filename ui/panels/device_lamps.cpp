#include "ui/panels/device_lamps.h"

#include <QHBoxLayout>
#include <QLabel>

#include "ui/panels/theme.h"

namespace foresight {
namespace {

constexpr int kLamp_px = 18;

const char* IconOf(DeviceRow::Lamp lamp) {
  switch (lamp) {
    case DeviceRow::Lamp::kIdle:
      return "idle";
    case DeviceRow::Lamp::kWell:
      return "well";
    case DeviceRow::Lamp::kDegraded:
      return "warning";
    case DeviceRow::Lamp::kMissing:
      return "error";
  }
  return "idle";
}

bool NeedsWords(DeviceRow::Lamp lamp) {
  return lamp == DeviceRow::Lamp::kDegraded || lamp == DeviceRow::Lamp::kMissing;
}

}  // namespace

QPixmap LampPixmap(DeviceRow::Lamp lamp) {
  return Icon(IconOf(lamp)).pixmap(kLamp_px, kLamp_px);
}

DeviceLamps::DeviceLamps(HeadViewModel* head, QWidget* parent) : QWidget(parent), head_(head) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  lamps_.resize(static_cast<std::size_t>(head_->Devices().size()));
  for (Lamp& lamp : lamps_) {
    lamp = {new QLabel, new QLabel, {}};
    lamp.sign->setObjectName(QStringLiteral("deviceLamp"));
    layout->addWidget(lamp.sign);
    layout->addWidget(lamp.name);
    layout->addSpacing(8);
  }
  connect(head_, &HeadViewModel::statusChanged, this, &DeviceLamps::Show);
  Show();
}

void DeviceLamps::Show() {
  const QVector<DeviceRow>& devices = head_->Devices();
  for (int i = 0; i < devices.size(); ++i) {
    const DeviceRow& device = devices[i];
    Lamp& lamp = lamps_[static_cast<std::size_t>(i)];
    const QString words = tr("%1: %2").arg(device.name, device.state);
    if (lamp.shown != device.lamp) lamp.sign->setPixmap(LampPixmap(device.lamp));
    lamp.shown = device.lamp;
    lamp.name->setText(NeedsWords(device.lamp) ? words : device.name);
    const QString all = device.detail.isEmpty() ? words : words + QChar('\n') + device.detail;
    lamp.sign->setToolTip(all);
    lamp.name->setToolTip(all);
  }
}

}  // namespace foresight
