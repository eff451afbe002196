#include "ui/panels/notice_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/panels/theme.h"

namespace foresight {

NoticeStrip::NoticeStrip(QWidget* parent) : QFrame(parent), icon_(new QLabel), text_(new QLabel) {
  setObjectName(QStringLiteral("notice"));
  auto* close = new QToolButton;
  close->setIcon(Icon("abort"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Close"));
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 6, 12, 6);
  layout->setSpacing(12);
  layout->addWidget(icon_);
  layout->addWidget(text_, 1);
  layout->addWidget(close);
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  hide();
}

void NoticeStrip::show(const Notice& notice) {
  const char* icon = notice.level == Notice::Level::kError     ? "error"
                     : notice.level == Notice::Level::kWarning ? "warning"
                                                               : "info";
  icon_->setPixmap(Icon(icon).pixmap(20, 20));
  notice_ = notice;
  text_->setText(QStringLiteral("<b>%1</b>&nbsp;&nbsp; %2")
                     .arg(notice.what.toHtmlEscaped(), notice.next.toHtmlEscaped()));
  setVisible(true);
}

}  // namespace foresight
