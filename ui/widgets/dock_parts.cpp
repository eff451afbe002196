#include "ui/widgets/dock_parts.h"

#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

namespace foresight {

QScrollArea* VerticalScroll(QWidget* content) {
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(content);
  return scroll;
}

void FillWithScroll(QWidget* panel, QWidget* content) {
  auto* whole = new QVBoxLayout(panel);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->addWidget(VerticalScroll(content));
}

QLabel* SectionTitle(const QString& text) {
  auto* label = new QLabel(text);
  label->setObjectName(QStringLiteral("sectionTitle"));
  label->setWordWrap(true);  // a long title must not push what stands below out of a narrow dock
  return label;
}

QLabel* WordsLabel(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QString::fromLatin1(name));
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

QPushButton* NarrowButton(const char* name, const QString& text, const QString& tip) {
  auto* button = new QPushButton(text);
  button->setObjectName(QString::fromLatin1(name));
  button->setToolTip(tip);
  button->setStyleSheet(QStringLiteral("padding: 6px 4px;"));
  button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  return button;
}

void ShowPossible(QPushButton* button, const QString& tip, const QString& why_not) {
  button->setEnabled(why_not.isEmpty());
  button->setToolTip(why_not.isEmpty() ? tip : tip + QLatin1Char('\n') + why_not);
}

QPixmap EmptyThumbnail() {
  QPixmap pixmap(kThumbnailSize);
  pixmap.fill(QColor(22, 25, 29));
  return pixmap;
}

}  // namespace foresight
