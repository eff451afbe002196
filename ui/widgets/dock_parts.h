#pragma once

#include <QPixmap>
#include <QString>

class QLabel;
class QScrollArea;
class QWidget;

namespace foresight {

/// A frame without a border round `content`; what does not fit scrolls up and down, never sideways.
QScrollArea* VerticalScroll(QWidget* content);
/// The same as all that `panel` shows.
void FillWithScroll(QWidget* panel, QWidget* content);

/// The title above a section of a dock.
QLabel* SectionTitle(const QString& text);

/// Of the small images in lists.
inline constexpr QSize kThumbnailSize(64, 48);
/// Stands where there is no image yet.
QPixmap EmptyThumbnail();

}  // namespace foresight
