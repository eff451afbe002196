#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <utility>

namespace foresight {

/// A process that is split off now and runs `body` when it is told to: it shares neither locks nor
/// connections that are made here in between, as another program would not. To be made while this
/// process has one thread only.
class OtherProcess {
 public:
  explicit OtherProcess(const std::function<int()>& body) {
    EXPECT_EQ(pipe(pipe_.data()), 0);
    child_ = fork();
    if (child_ != 0) {
      close(std::exchange(pipe_[0], -1));
      return;
    }
    close(pipe_[1]);
    char told = 0;
    _exit(read(pipe_[0], &told, 1) == 1 ? body() : 0);
  }
  ~OtherProcess() {
    if (child_ > 0) Run();
  }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

  /// What `body` returns (0 to 255), or -1 where a signal ended it. To be called once.
  int Run() {
    EXPECT_EQ(write(pipe_[1], "x", 1), 1);
    close(pipe_[1]);
    int status = 0;
    waitpid(std::exchange(child_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  std::array<int, 2> pipe_ = {-1, -1};
  pid_t child_ = -1;
};

}  // namespace foresight
