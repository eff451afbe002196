#include "ui/viewmodels/task_runner.h"

#include <QtConcurrent>

namespace foresight {

TaskRunner::TaskRunner(QObject* parent) : QObject(parent) {
  pool_.setMaxThreadCount(1);  // a replaced call ends before the next one begins
  poll_.setInterval(100);
  connect(&poll_, &QTimer::timeout, this, &TaskRunner::changed);
}

TaskRunner::~TaskRunner() {
  stop_.request_stop();
  pool_.waitForDone();
}

int TaskRunner::Permille() const {
  return Busy() ? progress_->permille.load(std::memory_order_relaxed) : 0;
}

QString TaskRunner::Stage() const {
  return Busy() ? QString::fromUtf8(progress_->stage.load(std::memory_order_relaxed)) : QString();
}

void TaskRunner::cancel() {
  stop_.request_stop();
}

void TaskRunner::Launch(const QString& title, Job job) {
  stop_.request_stop();
  stop_ = std::stop_source();
  title_ = title;
  progress_ = std::make_shared<Progress>();
  auto* watcher = new QFutureWatcher<Delivery>(this);
  connect(watcher, &QFutureWatcher<Delivery>::finished, this, [this, watcher] { Finish(watcher); });
  watcher_ = watcher;
  watcher->setFuture(QtConcurrent::run(
      &pool_, [job = std::move(job), progress = progress_, stop = stop_.get_token()] {
        RunContext context;
        context.stop = stop;
        context.progress = progress.get();
        return job(context);
      }));
  poll_.start();
  Q_EMIT changed();
}

void TaskRunner::Finish(QFutureWatcher<Delivery>* watcher) {
  watcher->deleteLater();
  if (watcher != watcher_) return;  // replaced by a newer call
  watcher_ = nullptr;
  poll_.stop();
  watcher->result()();
  Q_EMIT changed();
}

}  // namespace foresight
