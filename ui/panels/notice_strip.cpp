#include "ui/panels/notice_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/panels/theme.h"

namespace foresight {

NoticeStrip::NoticeStrip(QWidget* parent)
    : QFrame(parent), icon_(new QLabel), what_(new QLabel), next_(new QLabel) {
  setObjectName(QStringLiteral("notice"));
  auto* close = new QToolButton;
  close->setIcon(Icon("abort"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Close"));
  QFont bold = what_->font();
  bold.setBold(true);
  what_->setFont(bold);
  what_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 6, 12, 6);
  layout->setSpacing(12);
  layout->addWidget(icon_);
  layout->addWidget(what_);
  layout->addWidget(next_, 1);
  layout->addWidget(close);
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  hide();
}

QString NoticeStrip::Text() const {
  return what_->text();
}

void NoticeStrip::show(const Notice& notice) {
  const char* icon = notice.level == Notice::Level::kError     ? "error"
                     : notice.level == Notice::Level::kWarning ? "warning"
                                                               : "info";
  icon_->setPixmap(Icon(icon).pixmap(20, 20));
  what_->setText(notice.what);
  next_->setText(notice.next);
  setVisible(true);
}

}  // namespace foresight
