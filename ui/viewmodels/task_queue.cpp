#include "ui/viewmodels/task_queue.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

#include "core/base/memory.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {
namespace {

constexpr int kProgressInterval_ms = 100;
/// Tasks that wait for the disk do not keep the others from a core.
constexpr int kThreadsBesideTheCores = 4;

int ThreadLimit() {
  return static_cast<int>(std::thread::hardware_concurrency()) + kThreadsBesideTheCores;
}

}  // namespace

struct TaskQueue::Threads {
  tbb::global_control limit{tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(ThreadLimit())};
  tbb::task_arena arena{ThreadLimit() - 1, 0};
};

TaskQueue::TaskQueue(QObject* parent) : QObject(parent), threads_(std::make_unique<Threads>()) {
  poll_.setInterval(kProgressInterval_ms);
  connect(&poll_, &QTimer::timeout, this, &TaskQueue::changed);
}

TaskQueue::~TaskQueue() = default;

QVector<TaskInfo> TaskQueue::Tasks() const {
  QVector<TaskInfo> tasks;
  for (const TaskRunner* runner : runners_) runner->List(&tasks);
  std::sort(tasks.begin(), tasks.end(),
            [](const TaskInfo& a, const TaskInfo& b) { return a.id < b.id; });
  return tasks;
}

bool TaskQueue::Idle() const {
  return std::none_of(runners_.begin(), runners_.end(),
                      [](const TaskRunner* runner) { return runner->Busy(); });
}

void TaskQueue::Discard(std::shared_ptr<const void> value) {
  if (value) Enqueue([value = std::move(value)]() mutable { value.reset(); });
}

void TaskQueue::GiveMemoryBack() {
  Enqueue([] { foresight::GiveMemoryBack(); });
}

void TaskQueue::cancel(quint64 id) {
  for (TaskRunner* runner : runners_) runner->CancelTask(id);
}

void TaskQueue::Add(TaskRunner* runner) {
  runners_ << runner;
}

void TaskQueue::Remove(TaskRunner* runner) {
  runners_.removeAll(runner);
}

void TaskQueue::Enqueue(std::function<void()> work) {
  threads_->arena.enqueue(std::move(work));
}

void TaskQueue::OnRunnerChanged() {
  if (Idle())
    poll_.stop();
  else if (!poll_.isActive())
    poll_.start();
  Q_EMIT changed();
}

}  // namespace foresight
