#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <vector>

namespace foresight {

/// What an operator did, newest last, and how to take it back. One for each document.
class UndoStack : public QObject {
  Q_OBJECT

 public:
  using Step = std::function<void()>;

  explicit UndoStack(QObject* parent = nullptr) : QObject(parent) {}

  /// Something was done. `text` names it ("Accept valve 1"); steps of one `topic` can be forgotten
  /// together. What was taken back before can no longer be done again.
  void Push(const QString& text, const QString& topic, Step undo, Step redo);
  /// Forgets the steps of a topic: what they were about is gone.
  void Forget(const QString& topic);

  bool CanUndo() const { return done_ > 0; }
  bool CanRedo() const { return done_ < entries_.size(); }

 public Q_SLOTS:
  void undo();
  void redo();

 Q_SIGNALS:
  void changed();

 private:
  struct Entry {
    QString text;
    QString topic;
    Step undo;
    Step redo;
  };
  std::vector<Entry> entries_;
  std::size_t done_ = 0;  ///< entries before it were done, those behind it taken back
};

}  // namespace foresight
