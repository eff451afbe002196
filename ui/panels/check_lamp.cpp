#include "ui/panels/check_lamp.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMouseEvent>

#include "ui/panels/theme.h"
#include "ui/widgets/quiet_label.h"

namespace foresight {
namespace {

constexpr int kSign_px = 18;

const char* IconOf(CheckLight light) {
  switch (light) {
    case CheckLight::kNotSeen:
      return "idle";
    case CheckLight::kGood:
      return "well";
    case CheckLight::kAmber:
      return "warning";
    case CheckLight::kRed:
      return "error";
  }
  return "idle";
}

}  // namespace

QPixmap CheckPixmap(CheckLight light) {
  return Icon(IconOf(light)).pixmap(kSign_px, kSign_px);
}

CheckLamp::CheckLamp(ScanCheckModel* check, QWidget* parent)
    : QFrame(parent),
      check_(check),
      sign_(new QLabel),
      sentence_(new QuietLabel(QuietLabel::Ground::kWindow)) {
  setObjectName(QStringLiteral("checkLamp"));
  setFocusPolicy(Qt::NoFocus);
  setCursor(Qt::PointingHandCursor);
  setFixedHeight(30);  // as high as the tasks beside it
  sign_->setObjectName(QStringLiteral("checkSign"));
  sign_->setFixedSize(kSign_px, kSign_px);
  sentence_->setObjectName(QStringLiteral("checkSentence"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(12, 0, 12, 0);
  layout->setSpacing(8);
  layout->addWidget(sign_);
  layout->addWidget(sentence_, 1);
  connect(check_, &ScanCheckModel::changed, this, &CheckLamp::Show);
  Show();
}

void CheckLamp::Show() {
  sign_->setPixmap(CheckPixmap(check_->Light()));
  sentence_->SetText(check_->Sentence());
  setToolTip(tr("%1\nClick for details (Shift+K).").arg(check_->Sentence()));
  setAccessibleName(check_->Sentence());
}

void CheckLamp::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && rect().contains(event->pos())) Q_EMIT clicked();
}

}  // namespace foresight
