#include "hardware/net/wake_up.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace foresight {

WakeUp::WakeUp() : fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

WakeUp::~WakeUp() {
  ::close(fd_);
}

void WakeUp::Raise() const {
  // Cannot fail but for a full counter, and then it is raised already.
  [[maybe_unused]] const int raised = ::eventfd_write(fd_, 1);
}

void WakeUp::Lower() const {
  std::uint64_t count = 0;
  // Fails where it was not raised: then there is nothing to lower.
  [[maybe_unused]] const int lowered = ::eventfd_read(fd_, &count);
}

}  // namespace foresight
