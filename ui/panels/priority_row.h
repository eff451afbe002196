#pragma once

#include <QVector>
#include <QWidget>

class QHBoxLayout;

namespace foresight {

/// A row that shows as many of its widgets as there is room for, the important ones first, and
/// never asks for more than it is given.
class PriorityRow : public QWidget {
  Q_OBJECT

 public:
  explicit PriorityRow(QWidget* parent = nullptr);

  /// `priority`: 0 goes last. A widget with `wanted` false has no place until that changes.
  void Add(QWidget* widget, int priority, int stretch = 0);
  void SetWanted(QWidget* widget, bool wanted);
  /// After a widget's text has changed.
  void Arrange();

  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Item {
    QWidget* widget;
    int priority;
    bool wanted;
  };
  QHBoxLayout* layout_;
  QVector<Item> items_;
};

}  // namespace foresight
