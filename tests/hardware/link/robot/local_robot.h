#pragma once

#include <sys/socket.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "hardware/net/poll_fd.h"
#include "hardware/net/unix_listener.h"

namespace foresight {

/// The robot's end of a RobotSocket.
class LocalRobot {
 public:
  explicit LocalRobot(const std::filesystem::path& path) : fd_(ConnectUnix(path).value()) {}

  /// As much of it as the head takes within 10 s; whether that was all.
  bool Say(const std::string& text) const {
    std::size_t sent = 0;
    while (sent < text.size()) {
      const ssize_t n = ::send(fd_.Get(), text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (n > 0)
        sent += static_cast<std::size_t>(n);
      else if (errno != EAGAIN || !PollFd(fd_.Get(), POLLOUT, kLong, nullptr))
        return false;
    }
    return true;
  }
  /// The next line without its end; what came of it where the head closes or 10 s are over.
  std::string Line() {
    std::string line;
    for (char c = 0; PollFd(fd_.Get(), POLLIN, kLong, nullptr);) {
      if (::recv(fd_.Get(), &c, 1, 0) != 1 || c == '\n') return line;
      line += c;
    }
    return line;
  }
  /// Whether the head closes the connection within 10 s.
  bool IsClosed() const {
    std::array<char, 1000> ignored;
    while (PollFd(fd_.Get(), POLLIN, kLong, nullptr))
      if (::recv(fd_.Get(), ignored.data(), ignored.size(), 0) <= 0) return true;
    return false;
  }
  /// Reads a pose and answers it; returns its id.
  std::string AnswerOne(const std::string& answer, const std::string& reason = "") {
    const std::string id = nlohmann::json::parse(Line()).at("id");
    (void)Say(nlohmann::json{{"id", id}, {"answer", answer}, {"reason", reason}}.dump() + "\n");
    return id;
  }
  void Close() { fd_.Close(); }

 private:
  static constexpr std::chrono::seconds kLong{10};
  UniqueFd fd_;
};

}  // namespace foresight
