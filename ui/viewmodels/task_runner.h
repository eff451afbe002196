#pragma once

#include <QObject>
#include <QString>
#include <deque>
#include <exception>
#include <functional>
#include <memory>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "ui/viewmodels/task_queue.h"

namespace foresight {

/// What a new task means for those of the same line that have not ended.
enum class TaskPolicy {
  kReplace,      ///< they are cancelled and their answers dropped: only the newest counts
  kQueue,        ///< they come first
  kNeverCancel,  ///< they come first, and nothing stops them: they write what must not be lost
};

/// A line of long calls: runs them off the GUI thread, one at a time, and hands each answer over in
/// this object's thread.
class TaskRunner : public QObject {
  Q_OBJECT

 public:
  /// Without a queue it has one of its own.
  explicit TaskRunner(TaskQueue* queue = nullptr, TaskPolicy policy = TaskPolicy::kReplace,
                      QObject* parent = nullptr);
  /// Cancels and waits; tasks that are never cancelled are done to the end. Answers are dropped.
  ~TaskRunner() override;

  /// `work` runs in a worker thread and must own what it uses; `done` runs in this object's thread.
  template <class T>
  void Run(const QString& title, std::function<Result<T>(const RunContext&)> work,
           std::function<void(Result<T>)> done) {
    Launch(title, [work = std::move(work), done = std::move(done)](const RunContext& context) {
      auto result = std::make_shared<Result<T>>(Guarded<T>(work, context));
      return Delivery([result, done] { done(std::move(*result)); });
    });
  }

  bool Busy() const { return !tasks_.empty(); }
  /// Of the running task.
  QString Title() const;
  int Permille() const;
  QString Stage() const;

 public Q_SLOTS:
  /// Asks what runs and waits to stop; the answers, mostly kCancelled, are still handed over. Does
  /// nothing to tasks that are never cancelled.
  void cancel();

 Q_SIGNALS:
  void changed();  ///< a task began or ended

 private:
  friend class TaskQueue;
  using Delivery = std::function<void()>;
  using Job = std::function<Delivery(const RunContext&)>;
  struct Task;

  template <class T>
  static Result<T> Guarded(const std::function<Result<T>(const RunContext&)>& work,
                           const RunContext& context) {
    try {
      return work(context);
    } catch (const std::exception& fault) {
      return Fail(ErrorCode::kInvalidInput, "internal fault: {}", fault.what());
    }
  }

  void Launch(const QString& title, Job job);
  void StartFirst();
  void Finish(const std::shared_ptr<Task>& task, const Delivery& delivery);
  void Changed();
  // For the queue.
  void List(QVector<TaskInfo>* tasks) const;
  void CancelTask(quint64 id);

  std::unique_ptr<TaskQueue> own_queue_;
  TaskQueue* queue_;
  TaskPolicy policy_;
  std::deque<std::shared_ptr<Task>> tasks_;  ///< the first one runs
  /// How many jobs a thread still holds; the destructor waits for none.
  struct Running;
  std::shared_ptr<Running> running_;
};

}  // namespace foresight
