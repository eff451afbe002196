#include "ui/panels/source_gallery.h"

#include <QFrame>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPixmap>
#include <QScrollArea>
#include <QVBoxLayout>

#include "ui/panels/theme.h"

namespace foresight {
namespace {

constexpr QSize kThumbnail(300, 220);

const char* IconOf(const SourceAnswer& answer) {
  if (!answer.found) return "nothing";
  switch (answer.level) {
    case VerdictLevel::kConfirmed:
      return "confirmed";
    case VerdictLevel::kLikely:
      return "likely";
    case VerdictLevel::kUnsure:
      break;
  }
  return "unsure";
}

QColor ColorOf(const SourceAnswer& answer) {
  if (!answer.found) return state_color::kNeutral;
  switch (answer.level) {
    case VerdictLevel::kConfirmed:
      return state_color::kGood;
    case VerdictLevel::kLikely:
      return state_color::kCaution;
    case VerdictLevel::kUnsure:
      break;
  }
  return state_color::kBad;
}

QString VerdictText(const SourceAnswer& answer) {
  if (!answer.found) return QObject::tr("Nothing found");
  return QObject::tr("%1, %2").arg(QString::fromUtf8(ToString(answer.level)),
                                   QString::fromStdString(ProbabilityText(answer.probability)));
}

QPixmap ThumbnailOf(const ColorImage& picture) {
  const QImage borrowed(reinterpret_cast<const uchar*>(picture.data()), picture.width(),
                        picture.height(), picture.width() * 3, QImage::Format_RGB888);
  return QPixmap::fromImage(borrowed).scaled(kThumbnail, Qt::KeepAspectRatio,
                                             Qt::SmoothTransformation);
}

QWidget* CardOf(const SourceAnswer& answer) {
  auto* card = new QFrame;
  card->setObjectName(QStringLiteral("card"));
  auto* layout = new QGridLayout(card);
  layout->setHorizontalSpacing(8);
  auto* source = new QLabel(answer.source);
  source->setObjectName(QStringLiteral("faint"));
  auto* picture = new QLabel;
  picture->setPixmap(ThumbnailOf(answer.picture));
  picture->setFixedSize(kThumbnail);
  picture->setAlignment(Qt::AlignCenter);
  // Dark on the state's colour, as on the card of an object: the icons are drawn dark.
  auto* badge = new QFrame;
  badge->setObjectName(QStringLiteral("verdict_badge"));
  badge->setStyleSheet(QStringLiteral("QFrame { background: %1; border-radius: 4px; } "
                                      "QLabel { color: #16181c; font-weight: bold; }")
                           .arg(ColorOf(answer).name()));
  auto* badge_row = new QHBoxLayout(badge);
  badge_row->setContentsMargins(8, 3, 10, 3);
  auto* icon = new QLabel;
  icon->setPixmap(Icon(IconOf(answer)).pixmap(18, 18));
  badge_row->addWidget(icon);
  badge_row->addWidget(new QLabel(VerdictText(answer)));
  auto* text = new QLabel(answer.text);
  text->setWordWrap(true);
  text->setMaximumWidth(kThumbnail.width());
  layout->addWidget(source, 0, 0, 1, 2);
  layout->addWidget(picture, 1, 0, 1, 2);
  layout->addWidget(badge, 2, 0, 1, 2, Qt::AlignLeft);
  layout->addWidget(text, 3, 0, 1, 2);
  layout->setColumnStretch(1, 1);
  layout->setRowStretch(4, 1);
  return card;
}

}  // namespace

SourceGallery::SourceGallery(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("source_gallery"));
  auto* inner = new QWidget;
  grid_ = new QGridLayout(inner);
  grid_->setContentsMargins(12, 12, 12, 12);
  grid_->setSpacing(12);
  grid_->addWidget(
      new QLabel(tr("Draw a region and choose Compare sources (Shift+F): each source's answer "
                    "appears here.")));
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(inner);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(scroll);
  setMinimumHeight(60);
}

void SourceGallery::Show(const std::vector<SourceAnswer>& answers) {
  while (QLayoutItem* item = grid_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  for (std::size_t i = 0; i < answers.size(); ++i)
    grid_->addWidget(CardOf(answers[i]), 0, static_cast<int>(i));
}

}  // namespace foresight
