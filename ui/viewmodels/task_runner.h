#pragma once

#include <QFutureWatcher>
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <QTimer>
#include <exception>
#include <functional>
#include <memory>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace foresight {

/// One slot for long calls: runs them off the GUI thread, one at a time, and hands the answer over
/// on the GUI thread. A new call replaces the running one, whose answer is then dropped.
class TaskRunner : public QObject {
  Q_OBJECT

 public:
  explicit TaskRunner(QObject* parent = nullptr);
  ~TaskRunner() override;  ///< cancels and waits

  /// `work` runs in a worker thread and must own what it uses; `done` runs in this object's thread.
  template <class T>
  void Run(const QString& title, std::function<Result<T>(const RunContext&)> work,
           std::function<void(Result<T>)> done) {
    Launch(title, [work = std::move(work), done = std::move(done)](const RunContext& context) {
      auto result = std::make_shared<Result<T>>(Guarded<T>(work, context));
      return Delivery([result, done] { done(std::move(*result)); });
    });
  }

  bool Busy() const { return watcher_ != nullptr; }
  const QString& Title() const { return title_; }
  int Permille() const;
  QString Stage() const;

 public Q_SLOTS:
  /// Asks the running call to stop; its answer, mostly kCancelled, is still handed over.
  void cancel();

 Q_SIGNALS:
  void changed();  ///< began, ended, or got further (at most 10 times a second)

 private:
  using Delivery = std::function<void()>;
  using Job = std::function<Delivery(const RunContext&)>;

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
  void Finish(QFutureWatcher<Delivery>* watcher);

  QThreadPool pool_;
  QTimer poll_;
  QString title_;
  std::stop_source stop_;
  std::shared_ptr<Progress> progress_;
  QFutureWatcher<Delivery>* watcher_ = nullptr;
};

}  // namespace foresight
