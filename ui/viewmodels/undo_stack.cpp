#include "ui/viewmodels/undo_stack.h"

namespace foresight {
namespace {

constexpr std::size_t kMostSteps = 200;

}  // namespace

void UndoStack::Push(const QString& text, const QString& topic, Step undo, Step redo) {
  entries_.resize(done_);
  entries_.push_back({text, topic, std::move(undo), std::move(redo)});
  if (entries_.size() > kMostSteps) entries_.erase(entries_.begin());
  done_ = entries_.size();
  Q_EMIT changed();
}

void UndoStack::Forget(const QString& topic) {
  for (std::size_t i = entries_.size(); i-- > 0;) {
    if (entries_[i].topic != topic) continue;
    entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(i));
    if (i < done_) --done_;
  }
  Q_EMIT changed();
}

void UndoStack::undo() {
  if (!CanUndo()) return;
  const Step step = entries_[--done_].undo;  // a copy: the step may change the stack
  step();
  Q_EMIT changed();
}

void UndoStack::redo() {
  if (!CanRedo()) return;
  const Step step = entries_[done_++].redo;
  step();
  Q_EMIT changed();
}

}  // namespace foresight
