#pragma once

namespace foresight {

/// Ends the waiting of the thread that sleeps on a socket. Raised from any thread; stays raised
/// until that thread lowers it.
class WakeUp {
 public:
  /// Throws std::system_error when the process has no file descriptors left.
  WakeUp();
  ~WakeUp();
  WakeUp(const WakeUp&) = delete;
  WakeUp& operator=(const WakeUp&) = delete;

  void Raise() const;
  void Lower() const;
  int fd() const { return fd_; }

 private:
  int fd_;
};

}  // namespace foresight
