#include "ui/panels/source_gallery.h"

#include <QDialog>
#include <QFrame>
#include <QGridLayout>
#include <QLabel>
#include <QPixmap>
#include <QVBoxLayout>

#include "ui/panels/theme.h"

namespace foresight {
namespace {

constexpr QSize kThumbnail(300, 220);
constexpr int kColumns = 3;

const char* IconOf(const SourceAnswer& answer) {
  if (!answer.found) return "info";
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
  auto* icon = new QLabel;
  icon->setPixmap(Icon(IconOf(answer)).pixmap(20, 20));
  auto* verdict = new QLabel(VerdictText(answer));
  QFont bold = verdict->font();
  bold.setBold(true);
  verdict->setFont(bold);
  auto* text = new QLabel(answer.text);
  text->setWordWrap(true);
  text->setMaximumWidth(kThumbnail.width());
  layout->addWidget(source, 0, 0, 1, 2);
  layout->addWidget(picture, 1, 0, 1, 2);
  layout->addWidget(icon, 2, 0);
  layout->addWidget(verdict, 2, 1);
  layout->addWidget(text, 3, 0, 1, 2);
  layout->setColumnStretch(1, 1);
  layout->setRowStretch(4, 1);
  return card;
}

}  // namespace

QWidget* ShowSourceGallery(const std::vector<SourceAnswer>& answers, QWidget* parent) {
  auto* window = new QDialog(parent);
  window->setAttribute(Qt::WA_DeleteOnClose);
  window->setObjectName(QStringLiteral("source_gallery"));
  window->setWindowTitle(QObject::tr("One region, every source"));
  window->setModal(false);  // a scan may be running: the stop button must stay within reach
  auto* grid = new QGridLayout(window);
  grid->setContentsMargins(20, 20, 20, 20);
  grid->setSpacing(14);
  for (std::size_t i = 0; i < answers.size(); ++i)
    grid->addWidget(CardOf(answers[i]), static_cast<int>(i) / kColumns,
                    static_cast<int>(i) % kColumns);
  window->show();
  return window;
}

}  // namespace foresight
