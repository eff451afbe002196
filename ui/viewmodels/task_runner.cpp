#include "ui/viewmodels/task_runner.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>

namespace foresight {

struct TaskRunner::Task {
  quint64 id = 0;
  QString title;
  Job job;
  std::stop_source stop;
  Progress progress;
  bool dropped = false;  ///< replaced: nobody wants its answer
};

struct TaskRunner::Running {
  std::mutex mutex;
  std::condition_variable none;
  int jobs = 0;

  void Begin() {
    const std::lock_guard lock(mutex);
    ++jobs;
  }
  void End() {
    const std::lock_guard lock(mutex);
    --jobs;
    none.notify_all();
  }
  void WaitForNone() {
    std::unique_lock lock(mutex);
    none.wait(lock, [this] { return jobs == 0; });
  }
};

TaskRunner::TaskRunner(TaskQueue* queue, TaskPolicy policy, QObject* parent)
    : QObject(parent),
      own_queue_(queue == nullptr ? std::make_unique<TaskQueue>() : nullptr),
      queue_(queue == nullptr ? own_queue_.get() : queue),
      policy_(policy),
      running_(std::make_shared<Running>()) {
  queue_->Add(this);
}

TaskRunner::~TaskRunner() {
  cancel();
  running_->WaitForNone();
  if (policy_ == TaskPolicy::kNeverCancel && !tasks_.empty()) {
    // The first one has just been waited for.
    for (auto task = std::next(tasks_.begin()); task != tasks_.end(); ++task) (*task)->job({});
  }
  queue_->Remove(this);
}

QString TaskRunner::Title() const {
  return Busy() ? tasks_.front()->title : QString();
}

int TaskRunner::Permille() const {
  return Busy() ? tasks_.front()->progress.permille.load(std::memory_order_relaxed) : 0;
}

QString TaskRunner::Stage() const {
  return Busy() ? QString::fromUtf8(tasks_.front()->progress.stage.load(std::memory_order_relaxed))
                : QString();
}

void TaskRunner::cancel() {
  if (policy_ == TaskPolicy::kNeverCancel) return;
  for (const auto& task : tasks_) task->stop.request_stop();
}

void TaskRunner::CancelTask(quint64 id) {
  if (policy_ == TaskPolicy::kNeverCancel) return;
  for (const auto& task : tasks_)
    if (task->id == id) task->stop.request_stop();
}

void TaskRunner::List(QVector<TaskInfo>* tasks) const {
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    const Task& task = *tasks_[i];
    if (task.dropped) continue;
    tasks->push_back({task.id, task.title,
                      QString::fromUtf8(task.progress.stage.load(std::memory_order_relaxed)),
                      task.progress.permille.load(std::memory_order_relaxed), i == 0,
                      policy_ != TaskPolicy::kNeverCancel});
  }
}

void TaskRunner::Launch(const QString& title, Job job) {
  if (policy_ == TaskPolicy::kReplace && !tasks_.empty()) {
    cancel();
    for (const auto& task : tasks_) task->dropped = true;
    tasks_.erase(std::next(tasks_.begin()), tasks_.end());
  }
  auto task = std::make_shared<Task>();
  task->id = queue_->NextId();
  task->title = title;
  task->job = std::move(job);
  tasks_.push_back(std::move(task));
  if (tasks_.size() == 1) StartFirst();
  Changed();
}

void TaskRunner::StartFirst() {
  running_->Begin();
  queue_->Enqueue([this, task = tasks_.front(), running = running_] {
    RunContext context;
    context.stop = task->stop.get_token();
    context.progress = &task->progress;
    Delivery delivery = task->job(context);
    task->job = nullptr;  // what it owns goes here and not in the GUI thread
    QMetaObject::invokeMethod(
        this, [this, task, delivery = std::move(delivery)] { Finish(task, delivery); },
        Qt::QueuedConnection);
    running->End();  // from here on this object may be gone
  });
}

void TaskRunner::Finish(const std::shared_ptr<Task>& task, const Delivery& delivery) {
  tasks_.pop_front();
  if (!tasks_.empty()) StartFirst();
  if (!task->dropped) delivery();
  Changed();
}

void TaskRunner::Changed() {
  Q_EMIT changed();
  queue_->OnRunnerChanged();
}

}  // namespace foresight
