#include "ui/panels/priority_row.h"

#include <QHBoxLayout>
#include <algorithm>

namespace foresight {

PriorityRow::PriorityRow(QWidget* parent) : QWidget(parent), layout_(new QHBoxLayout(this)) {
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setSpacing(12);
  layout_->setSizeConstraint(QLayout::SetNoConstraint);
  layout_->addStretch(0);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
}

void PriorityRow::Add(QWidget* widget, int priority, int stretch) {
  items_.push_back({widget, priority, true});
  if (stretch == 0) widget->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Preferred);
  layout_->insertWidget(layout_->count() - 1, widget, stretch);
}

void PriorityRow::SetWanted(QWidget* widget, bool wanted) {
  for (Item& item : items_) {
    if (item.widget != widget || item.wanted == wanted) continue;
    item.wanted = wanted;
    Arrange();
  }
}

void PriorityRow::Arrange() {
  QVector<int> order;
  for (int i = 0; i < items_.size(); ++i) order << i;
  std::stable_sort(order.begin(), order.end(),
                   [this](int a, int b) { return items_[a].priority < items_[b].priority; });
  int left = width();
  for (const int i : order) {
    const int needed = items_[i].widget->minimumSizeHint().width();
    const bool shown = items_[i].wanted && needed <= left;
    if (shown) left -= needed + layout_->spacing();
    if (items_[i].widget->isHidden() == shown) items_[i].widget->setVisible(shown);
  }
}

QSize PriorityRow::minimumSizeHint() const {
  int height = 0;
  for (const Item& item : items_) height = std::max(height, item.widget->sizeHint().height());
  return {0, height};
}

void PriorityRow::resizeEvent(QResizeEvent*) {
  Arrange();
}

}  // namespace foresight
