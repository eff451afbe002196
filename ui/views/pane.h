#pragma once

#include <QWidget>

class QHBoxLayout;
class QLabel;
class QVBoxLayout;

namespace foresight {

class ColorBar;
class QuietLabel;

/// The frame that all three panes share: a row of controls, a canvas with a colour bar, a hint in
/// their place while there is nothing to show, and a line of caption that says what is seen and how
/// old it is.
class Pane : public QWidget {
  Q_OBJECT

 public:
  Pane(QWidget* canvas, const QString& hint, QWidget* parent);

  QWidget* Canvas() const { return canvas_; }
  void ShowCanvas(bool show);
  void SetHint(const QString& hint);
  bool HintShown() const;
  /// `details` appear when the mouse rests on it; without them the caption itself does.
  void SetCaption(const QString& caption, const QString& details = {});
  QString Caption() const;
  ColorBar* Colors() { return colors_; }

 protected:
  QHBoxLayout* Controls() { return controls_; }
  QVBoxLayout* Footer() { return footer_; }

 private:
  QWidget* canvas_;
  QLabel* hint_;
  QuietLabel* caption_;
  QHBoxLayout* controls_;
  ColorBar* colors_;
  QVBoxLayout* footer_;
};

}  // namespace foresight
