#include "app/workstation/quit_on_signal.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QTimer>
#include <csignal>

namespace foresight {
namespace {

struct Signals : testing::TestWithParam<int> {};

TEST_P(Signals, StopTheHeadAndThenEndTheEventLoopInOrder) {
  bool stopped = false;
  const QuitOnSignal quit_on_signal([&] { stopped = true; });
  QTimer::singleShot(0, [] { std::raise(GetParam()); });
  QTimer guard;
  guard.start(10'000);
  QObject::connect(&guard, &QTimer::timeout, [] { QApplication::exit(1); });
  EXPECT_EQ(QApplication::exec(), 0);
  EXPECT_TRUE(stopped);
}

INSTANTIATE_TEST_SUITE_P(TermAndInt, Signals, testing::Values(SIGTERM, SIGINT));

}  // namespace
}  // namespace foresight
