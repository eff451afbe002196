#include "ui/panels/log_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "ui/panels/command_button.h"
#include "ui/panels/theme.h"

namespace foresight {

LogStrip::LogStrip(LogModel* log, CommandTable* commands, QWidget* parent)
    : QFrame(parent),
      log_(log),
      commands_(commands),
      icon_(new QLabel),
      text_(new QLabel),
      more_(new QLabel),
      action_(new QPushButton),
      acknowledge_(new QPushButton(tr("Acknowledge"))) {
  setObjectName(QStringLiteral("notice"));
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
  more_->setObjectName(QStringLiteral("faint"));
  action_->setObjectName(QStringLiteral("noticeAction"));
  for (QPushButton* button : {action_, acknowledge_}) button->setFocusPolicy(Qt::NoFocus);
  icon_->setFixedWidth(22);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 2, 12, 2);
  layout->setSpacing(10);
  layout->addWidget(icon_);
  layout->addWidget(text_, 1);
  layout->addWidget(more_);
  layout->addWidget(action_);
  layout->addWidget(acknowledge_);
  BindButton(acknowledge_, commands, "log.acknowledge");
  setFixedHeight(2 * fontMetrics().lineSpacing() + 8);
  connect(action_, &QPushButton::clicked, this, [this] {
    if (const LogEntry* top = log_->Top())
      commands_->Run(top->notice.command.toLatin1().constData());
  });
  connect(log_, &LogModel::changed, this, &LogStrip::ShowTop);
  connect(commands_, &CommandTable::changed, this, [this] { ShowAction(log_->Top()); });
  ShowTop();
}

QString LogStrip::Text() const {
  return text_->text();
}

void LogStrip::ShowTop() {
  const LogEntry* top = log_->Top();
  acknowledge_->setVisible(log_->Open() > 0);
  more_->setText(log_->Open() > 1 ? tr("%1 more").arg(log_->Open() - 1) : QString());
  ShowAction(top);
  if (top == nullptr) {
    icon_->clear();
    text_->clear();
    text_->setToolTip({});
    return;
  }
  const char* icon = top->notice.level == Notice::Level::kError     ? "error"
                     : top->notice.level == Notice::Level::kWarning ? "warning"
                                                                    : "info";
  icon_->setPixmap(Icon(icon).pixmap(18, 18));
  QString what = top->notice.what.toHtmlEscaped();
  if (top->count > 1) what += tr(" (%1 times)").arg(top->count);
  text_->setText(QStringLiteral("<b>%1</b>&nbsp; %2").arg(what, top->notice.next.toHtmlEscaped()));
  text_->setToolTip(top->notice.what + QLatin1Char('\n') + top->notice.next);
}

void LogStrip::ShowAction(const LogEntry* top) {
  const bool offered = top != nullptr && !top->notice.command.isEmpty();
  if (action_->isHidden() == offered) action_->setVisible(offered);
  if (!offered) return;
  const Command& command = commands_->Get(top->notice.command.toLatin1().constData());
  action_->setText(command.text);
  action_->setToolTip(ToolTipOf(command));
  action_->setEnabled(command.Allowed());
}

}  // namespace foresight
