#include "ui/panels/head_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

#include "core/geometry/angles.h"
#include "ui/panels/device_lamps.h"
#include "ui/panels/theme.h"

namespace foresight {
namespace {

void SetBadge(QLabel* badge, const QString& text, const QColor& color) {
  badge->setText(text);
  badge->setStyleSheet(QStringLiteral("background: %1;").arg(color.name()));
}

QColor ColorOf(HeadState state) {
  switch (state) {
    case HeadState::kReady:
      return state_color::kGood;
    case HeadState::kSweeping:
    case HeadState::kHoming:
      return state_color::kActive;
    case HeadState::kStopping:
      return state_color::kCaution;
    case HeadState::kFault:
      return state_color::kBad;
    case HeadState::kDisconnected:
      break;
  }
  return state_color::kNeutral;
}

}  // namespace

HeadStrip::HeadStrip(HeadViewModel* head, SessionModel* session, QWidget* parent)
    : QFrame(parent), head_(head), session_(session) {
  setObjectName(QStringLiteral("strip"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 6, 12, 6);
  layout->setSpacing(16);
  const auto add = [layout](int width, const char* name) {
    auto* label = new QLabel;
    label->setMinimumWidth(width);
    label->setObjectName(QString::fromLatin1(name));
    layout->addWidget(label);
    return label;
  };
  mode_ = add(0, "badge");
  state_ = add(0, "badge");
  angle_ = add(120, "");
  speed_ = add(210, "");
  lines_ = add(140, "");
  sweep_ = new QProgressBar;
  sweep_->setRange(0, 1000);
  sweep_->setTextVisible(false);
  sweep_->setFixedSize(120, 10);
  layout->addWidget(sweep_);
  layout->addWidget(new DeviceLamps(head_));
  message_ = new QLabel;
  message_->setWordWrap(true);
  layout->addWidget(message_, 1);
  auto* stop = new QPushButton(Icon("stop"), tr(" STOP HEAD  (F12)"));
  stop->setObjectName(QStringLiteral("stopButton"));
  stop->setToolTip(
      tr("Stops the scanner's motor at once. The robot's emergency stop is separate."));
  layout->addWidget(stop);
  connect(stop, &QPushButton::clicked, head_, &HeadViewModel::stop);
  connect(head_, &HeadViewModel::statusChanged, this, &HeadStrip::ShowStatus);
  connect(session_, &SessionModel::modeChanged, this, &HeadStrip::ShowMode);
  ShowMode();
  ShowStatus();
}

void HeadStrip::ShowMode() {
  switch (session_->Mode()) {
    case SessionMode::kLive:
      SetBadge(mode_, tr("LIVE"), state_color::kGood);
      break;
    case SessionMode::kSimulation:
      SetBadge(mode_, tr("SIMULATION"), state_color::kActive);
      break;
    case SessionMode::kReplay:
      SetBadge(mode_, tr("REPLAY"), state_color::kCaution);
      break;
  }
}

void HeadStrip::ShowStatus() {
  const HeadStatus& status = head_->LastStatus();
  SetBadge(state_, tr("Head: %1").arg(QString::fromUtf8(ToString(status.state))),
           ColorOf(status.state));
  angle_->setText(tr("Angle %1°").arg(DegreesFromRadians(status.angle_rad), 0, 'f', 2));
  speed_->setText(tr("Speed %1 °/s, asked %2 °/s")
                      .arg(DegreesFromRadians(status.speed_rad_s), 0, 'f', 1)
                      .arg(DegreesFromRadians(status.commanded_speed_rad_s), 0, 'f', 1));
  const bool sweeping = status.state == HeadState::kSweeping;
  lines_->setVisible(sweeping);
  sweep_->setVisible(sweeping);
  lines_->setText(tr("Line %1 of %2").arg(status.lines).arg(status.expected_lines));
  sweep_->setValue(static_cast<int>(1000.0 * head_->ScanProgress()));
  message_->setText(QString::fromStdString(status.message));
}

}  // namespace foresight
