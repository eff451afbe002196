#include "ui/panels/head_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

#include "core/geometry/angles.h"
#include "ui/panels/command_button.h"
#include "ui/panels/device_lamps.h"
#include "ui/panels/priority_row.h"
#include "ui/panels/theme.h"
#include "ui/widgets/quiet_label.h"

namespace foresight {
namespace {

void SetBadge(QLabel* badge, const QString& text, const QColor& color) {
  const QString style = QStringLiteral("background: %1;").arg(color.name());
  if (badge->text() != text) badge->setText(text);
  if (badge->styleSheet() != style) badge->setStyleSheet(style);
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

QColor ColorOf(const HeadAnswers& answers, HeadState state) {
  if (answers.StopLatched()) return state_color::kBad;
  return answers.Current() ? ColorOf(state) : state_color::kCaution;
}

}  // namespace

HeadStrip::HeadStrip(HeadViewModel* head, CommandTable* commands, QWidget* parent)
    : QFrame(parent), head_(head), row_(new PriorityRow) {
  setObjectName(QStringLiteral("strip"));
  const auto add = [this](int priority, int width, const char* name) {
    auto* label = new QLabel;
    label->setMinimumWidth(width);
    label->setObjectName(QString::fromLatin1(name));
    row_->Add(label, priority);
    return label;
  };
  mode_ = add(0, 0, "badge");
  back_ = new QPushButton(tr("Back to live"));
  BindButton(back_, commands, "view.live");
  row_->Add(back_, 1);
  state_ = add(2, 0, "badge");
  angle_ = add(5, 110, "");
  speed_ = add(7, 200, "");
  lines_ = add(4, 120, "");
  sweep_ = new QProgressBar;
  sweep_->setRange(0, 1000);
  sweep_->setTextVisible(false);
  sweep_->setFixedSize(100, 10);
  row_->Add(sweep_, 6);
  row_->Add(new DeviceLamps(head_), 3);
  // One line: a strip that grows would move the panes under the operator's mouse.
  message_ = new QuietLabel(QuietLabel::Ground::kStrip);
  row_->Add(message_, 8, 1);
  release_ = new QPushButton(tr("Release"));
  BindButton(release_, commands, "head.release");
  auto* stop = new QPushButton(Icon("stop"), tr(" STOP HEAD  (F12)"));
  stop->setObjectName(QStringLiteral("stopButton"));
  stop->setFocusPolicy(Qt::NoFocus);
  BindButton(stop, commands, "head.stop");

  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 4, 12, 4);
  layout->setSpacing(12);
  layout->addWidget(row_, 1);
  layout->addWidget(release_);
  layout->addWidget(stop);
  connect(head_, &HeadViewModel::statusChanged, this, &HeadStrip::ShowStatus);
  ShowDocument(SessionMode::kLive, {});
  ShowStatus();
}

void HeadStrip::ShowDocument(SessionMode mode, const QString& details, bool replayed) {
  row_->SetWanted(back_, mode == SessionMode::kReplay);
  switch (mode) {
    case SessionMode::kLive:
      SetBadge(mode_, tr("LIVE"), state_color::kGood);
      break;
    case SessionMode::kSimulation:
      SetBadge(mode_, tr("SIMULATION"), state_color::kActive);
      break;
    case SessionMode::kReplay:
      SetBadge(mode_, (replayed ? tr("REPLAY: %1") : tr("REVIEW: %1")).arg(details),
               state_color::kCaution);
      break;
  }
  row_->Arrange();
}

void HeadStrip::ShowStatus() {
  const HeadStatus& status = head_->LastStatus();
  const HeadAnswers& answers = head_->Answers();
  SetBadge(state_, answers.Text(), ColorOf(answers, status.state));
  release_->setVisible(head_->StopLatched());
  ShowMotion(status, answers);
  message_->SetText(QString::fromStdString(status.message));
  row_->SetWanted(message_, !status.message.empty());
  row_->Arrange();
}

void HeadStrip::ShowMotion(const HeadStatus& status, const HeadAnswers& answers) {
  const bool current = answers.Current();
  // Nobody reads the motor of a head whose devices are not connected.
  const bool known = status.state != HeadState::kDisconnected;
  const QString angle =
      known ? tr("Angle %1°").arg(DegreesFromRadians(status.angle_rad), 0, 'f', 2) : tr("Angle –");
  const QString lines = tr("Line %1 of %2").arg(status.lines).arg(status.expected_lines);
  const QString old = tr("%1, %2 ago");
  angle_->setText(current || !known ? angle : old.arg(angle, answers.Silence()));
  lines_->setText(current ? lines : old.arg(lines, answers.Silence()));
  speed_->setText(current && known
                      ? tr("Speed %1 °/s, asked %2 °/s")
                            .arg(DegreesFromRadians(status.speed_rad_s), 0, 'f', 1)
                            .arg(DegreesFromRadians(status.commanded_speed_rad_s), 0, 'f', 1)
                      : tr("Speed –"));
  for (QWidget* value : QVector<QWidget*>{angle_, lines_, speed_, sweep_})
    value->setEnabled(current);
  const bool sweeping = status.state == HeadState::kSweeping;
  row_->SetWanted(lines_, sweeping);
  row_->SetWanted(sweep_, sweeping);
  sweep_->setValue(static_cast<int>(1000.0 * head_->ScanProgress()));
}

}  // namespace foresight
