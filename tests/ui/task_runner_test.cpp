#include "ui/viewmodels/task_runner.h"

#include <gtest/gtest.h>

#include <QThread>
#include <stdexcept>

#include "tests/ui/wait_for.h"

namespace foresight {
namespace {

Result<int> UntilCancelled(const RunContext& context) {
  while (!context.Cancelled()) QThread::yieldCurrentThread();
  return Fail(ErrorCode::kCancelled, "stopped as asked");
}

TEST(TaskRunner, HandsTheAnswerOverOnTheCallersThread) {
  TaskRunner runner;
  int answer = 0;
  QThread* thread = nullptr;
  runner.Run<int>(
      "add", [](const RunContext&) -> Result<int> { return 42; },
      [&](const Result<int>& result) {
        answer = *result;
        thread = QThread::currentThread();
      });
  ASSERT_TRUE(WaitFor([&] { return !runner.Busy(); }));
  EXPECT_EQ(answer, 42);
  EXPECT_EQ(thread, QThread::currentThread());
}

TEST(TaskRunner, CancelStopsTheWorkAndSaysSo) {
  TaskRunner runner;
  Result<int> answer = 1;
  runner.Run<int>("wait", UntilCancelled, [&](const Result<int>& result) { answer = result; });
  EXPECT_TRUE(runner.Busy());
  runner.cancel();
  ASSERT_TRUE(WaitFor([&] { return !runner.Busy(); }));
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, ErrorCode::kCancelled);
}

TEST(TaskRunner, ANewTaskReplacesTheRunningOneWhoseAnswerIsDropped) {
  TaskRunner runner;
  int handed_over = 0;
  runner.Run<int>("old", UntilCancelled, [&](const Result<int>&) { handed_over += 100; });
  runner.Run<int>(
      "new", [](const RunContext&) -> Result<int> { return 1; },
      [&](const Result<int>& result) { handed_over += *result; });
  ASSERT_TRUE(WaitFor([&] { return !runner.Busy(); }));
  EXPECT_EQ(handed_over, 1);
}

TEST(TaskRunner, AnExceptionInTheWorkBecomesAnError) {
  TaskRunner runner;
  Result<int> answer = 1;
  runner.Run<int>(
      "throw", [](const RunContext&) -> Result<int> { throw std::runtime_error("broken"); },
      [&](const Result<int>& result) { answer = result; });
  ASSERT_TRUE(WaitFor([&] { return !runner.Busy(); }));
  ASSERT_FALSE(answer);
  EXPECT_NE(answer.error().message.find("broken"), std::string::npos);
}

TEST(TaskRunner, DestroyingItCancelsTheWorkAndHandsNothingOver) {
  bool handed_over = false;
  {
    TaskRunner runner;
    runner.Run<int>("wait", UntilCancelled, [&](const Result<int>&) { handed_over = true; });
  }
  QCoreApplication::processEvents();
  EXPECT_FALSE(handed_over);
}

}  // namespace
}  // namespace foresight
