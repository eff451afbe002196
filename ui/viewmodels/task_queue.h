#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <QVector>
#include <functional>
#include <memory>
#include <stop_token>

#include "core/base/run_context.h"

namespace foresight {

class TaskRunner;

/// A task as the operator sees it in the list.
struct TaskInfo {
  quint64 id = 0;
  QString title;
  QString stage;  ///< empty until the work reports one
  int permille = 0;
  bool running = false;  ///< else it waits for the one before it in its line
  bool cancellable = true;
};

/// All long work of the program, in one place: the threads that do it (TBB's, made once) and the
/// list of what runs and waits. Work comes in through TaskRunners. Lives in the GUI thread and
/// outlives its runners.
class TaskQueue : public QObject {
  Q_OBJECT

 public:
  explicit TaskQueue(QObject* parent = nullptr);
  ~TaskQueue() override;

  /// What runs and what waits, oldest first.
  QVector<TaskInfo> Tasks() const;
  bool Idle() const;
  /// Lets go of a large value on one of the threads: to give a scan's memory back takes
  /// milliseconds that the window has other use for.
  void Discard(std::shared_ptr<const void> value);
  /// Gives memory that was freed back to the system, on one of the threads. The C library keeps it
  /// otherwise: a sitting of 100 scans then holds twice what it uses.
  void GiveMemoryBack();

 public Q_SLOTS:
  /// Asks one task to stop; one that cannot be cancelled goes on.
  void cancel(quint64 id);

 Q_SIGNALS:
  void changed();  ///< a task began, ended, or got further (at most 10 times a second)

 private:
  friend class TaskRunner;
  struct Threads;

  void Add(TaskRunner* runner);
  void Remove(TaskRunner* runner);
  quint64 NextId() { return ++last_id_; }
  /// Runs `work` on one of the threads, soon.
  void Enqueue(std::function<void()> work);
  void OnRunnerChanged();

  std::unique_ptr<Threads> threads_;
  QVector<TaskRunner*> runners_;
  quint64 last_id_ = 0;
  QTimer poll_;
};

}  // namespace foresight
