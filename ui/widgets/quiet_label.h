#pragma once

#include <QWidget>

namespace foresight {

/// One line of text that changes by itself, such as an age. A change draws this widget alone: it
/// asks for no new layout, and it is opaque, so that nothing below it is drawn again. What does not
/// fit is cut off with an ellipsis.
class QuietLabel : public QWidget {
  Q_OBJECT

 public:
  /// What the label lies on; colours are those of the theme.
  enum class Ground { kWindow, kCard, kStrip };

  explicit QuietLabel(Ground ground, QWidget* parent = nullptr);

  /// The whole text is the label's tip, too.
  void SetText(const QString& text);
  QString Text() const { return text_; }

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString text_;
  QColor ground_color_;
  QColor text_color_;
};

}  // namespace foresight
