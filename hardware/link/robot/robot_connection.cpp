#include "hardware/link/robot/robot_connection.h"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "hardware/link/robot/robot_answer.h"
#include "hardware/net/poll_fd.h"

namespace foresight {
namespace {

bool IsForLater(int error) {
  return error == EAGAIN || error == EINTR;
}

tl::unexpected<Error> Gone(const char* what, int error) {
  return Fail(ErrorCode::kDevice, "robot: {}: {}", what, std::generic_category().message(error));
}

}  // namespace

bool RobotConnection::HasMoreToRead() const {
  return PollFd(fd(), POLLIN, std::chrono::microseconds(0), nullptr);
}

Status RobotConnection::WriteLine(std::string line) {
  out_ = std::move(line);
  return Write();
}

Status RobotConnection::Write() {
  while (!out_.empty()) {
    const ssize_t n = ::send(fd(), out_.data(), out_.size(), MSG_NOSIGNAL);
    if (n >= 0)
      out_.erase(0, static_cast<std::size_t>(n));
    else if (IsForLater(errno))
      return {};
    else
      return Gone("cannot send", errno);
  }
  return {};
}

Result<std::vector<std::string>> RobotConnection::ReadLines() {
  std::array<char, kLongestRobotLine_bytes> buffer;
  const ssize_t n = ::recv(fd(), buffer.data(), buffer.size(), 0);
  if (n == 0) return Fail(ErrorCode::kDevice, "robot: closed the connection");
  if (n < 0) {
    if (IsForLater(errno)) return std::vector<std::string>();
    return Gone("cannot receive", errno);
  }
  in_.append(buffer.data(), static_cast<std::size_t>(n));
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end; (end = in_.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(in_.substr(begin, end - begin));
  in_.erase(0, begin);
  if (in_.size() > kLongestRobotLine_bytes)
    return Fail(ErrorCode::kBadData, "robot: sent more than {} bytes without a line end",
                kLongestRobotLine_bytes);
  return lines;
}

}  // namespace foresight
