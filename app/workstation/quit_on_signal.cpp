#include "app/workstation/quit_on_signal.h"

#include <fcntl.h>
#include <unistd.h>

#include <QCoreApplication>
#include <array>
#include <csignal>
#include <system_error>

namespace foresight {
namespace {

/// A handler may do next to nothing, so it only writes a byte that the event loop wakes up for.
std::array<int, 2> pipe_ends = {-1, -1};

void Wake(int) {
  const char byte = 0;
  [[maybe_unused]] const auto written = write(pipe_ends[1], &byte, 1);
}

void Handle(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGTERM, SIGINT}) sigaction(signal, &action, nullptr);
}

}  // namespace

QuitOnSignal::QuitOnSignal(std::function<void()> before) : before_(std::move(before)) {
  if (pipe2(pipe_ends.data(), O_CLOEXEC | O_NONBLOCK) != 0)
    throw std::system_error(errno, std::generic_category(), "signals: pipe2");
  notifier_ = std::make_unique<QSocketNotifier>(pipe_ends[0], QSocketNotifier::Read);
  QObject::connect(notifier_.get(), &QSocketNotifier::activated, notifier_.get(), [this] {
    notifier_->setEnabled(false);
    before_();
    QCoreApplication::quit();
  });
  Handle(&Wake);
}

QuitOnSignal::~QuitOnSignal() {
  Handle(SIG_DFL);
  notifier_.reset();
  for (int& end : pipe_ends) close(std::exchange(end, -1));
}

}  // namespace foresight
