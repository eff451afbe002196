#include "ui/widgets/dock_parts.h"

#include <QLabel>
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
  return label;
}

QPixmap EmptyThumbnail() {
  QPixmap pixmap(kThumbnailSize);
  pixmap.fill(QColor(22, 25, 29));
  return pixmap;
}

}  // namespace foresight
