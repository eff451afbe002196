#pragma once

#include <QPixmap>
#include <QString>

class QLabel;
class QPushButton;
class QScrollArea;
class QWidget;

namespace foresight {

/// A frame without a border round `content`; what does not fit scrolls up and down, never sideways.
QScrollArea* VerticalScroll(QWidget* content);
/// The same as all that `panel` shows.
void FillWithScroll(QWidget* panel, QWidget* content);

/// The title above a section of a dock.
QLabel* SectionTitle(const QString& text);

/// A label that breaks its lines and whose text can be copied.
QLabel* WordsLabel(const char* name);

/// A button that shares a narrow dock's width with the others of its row.
QPushButton* NarrowButton(const char* name, const QString& text, const QString& tip = {});
/// Enabled where `why_not` is empty; else the tip says why not.
void ShowPossible(QPushButton* button, const QString& tip, const QString& why_not);

/// Of the small images in lists.
inline constexpr QSize kThumbnailSize(64, 48);
/// Stands where there is no image yet.
QPixmap EmptyThumbnail();

}  // namespace foresight
