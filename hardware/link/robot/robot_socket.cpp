#include "hardware/link/robot/robot_socket.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <thread>

#include "core/base/log.h"
#include "core/mission/pose_json.h"
#include "hardware/link/robot/robot_connection.h"
#include "hardware/net/unix_listener.h"
#include "hardware/net/wake_up.h"

namespace foresight {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = RobotAnswer::Kind;
using std::chrono::milliseconds;

/// A robot that says so much between two poses, and answers none, is not what belongs there.
constexpr int kMostStrayLines = 100;
/// A second robot reads this and finds the connection closed.
constexpr const char* kTaken = "{\"error\": \"another robot is connected\"}\n";

/// A pose that waits for its answer.
struct Question {
  std::string id;
  std::string line;
  std::optional<RobotAnswer> answer = std::nullopt;
};

}  // namespace

/// The thread owns the connection; whoever sends waits for it to set an answer.
struct RobotSocket::Impl {
  Impl(UnixListener the_listener, milliseconds the_timeout)
      : listener(std::move(the_listener)), timeout(the_timeout) {}

  void Run();
  void Turn();
  void Service();
  void TakeNewcomers();
  void HearRobot();
  void ReadRobot();
  void OnLine(const std::string& line);
  void BeginQuestion();
  void EndLateQuestion();
  void Answer(Kind kind, std::string reason);
  void Disconnect(const std::string& why);
  void Drop(const std::string& why);
  milliseconds TimeToWait() const;
  std::string NobodyThere() const;

  UnixListener listener;
  milliseconds timeout;
  WakeUp wake;
  std::atomic<bool> stopping = false;
  std::atomic<bool> robot_is_there = false;

  std::mutex one_sender;
  std::mutex mutex;
  std::condition_variable answered;
  Question* asked = nullptr;  ///< guarded by mutex; its answer too

  // The thread's own.
  std::optional<RobotConnection> robot;
  Question* question = nullptr;  ///< that was given to the robot
  Clock::time_point deadline;
  int stray_lines = 0;       ///< since the last pose
  std::string last_trouble;  ///< of them
  bool listener_rests = false;

  std::thread thread;
};

void RobotSocket::Impl::Run() {
  while (!stopping) try {
      Turn();
    } catch (const std::exception& failure) {  // no memory
      Drop(failure.what());
    }
  const std::lock_guard lock(mutex);
  if (asked == nullptr) return;
  asked->answer =
      RobotAnswer{question ? Kind::kNoAnswer : Kind::kNobodyThere, "The head's program ends."};
  answered.notify_all();
}

void RobotSocket::Impl::Turn() {
  const short wanted = robot && robot->HasMoreToWrite() ? POLLIN | POLLOUT : POLLIN;
  std::array<pollfd, 3> waiting{{{wake.fd(), POLLIN, 0},
                                 {listener_rests ? -1 : listener.fd(), POLLIN, 0},
                                 {robot ? robot->fd() : -1, wanted, 0}}};
  ::poll(waiting.data(), waiting.size(), static_cast<int>(TimeToWait().count()));
  listener_rests = false;
  wake.Lower();
  Service();
  EndLateQuestion();
  BeginQuestion();
}

milliseconds RobotSocket::Impl::TimeToWait() const {
  constexpr milliseconds kRest{100};
  milliseconds wait{-1};
  if (question)
    wait = std::max(milliseconds(0), std::chrono::ceil<milliseconds>(deadline - Clock::now()));
  if (!listener_rests) return wait;
  return wait < milliseconds(0) ? kRest : std::min(wait, kRest);
}

void RobotSocket::Impl::Service() {
  HearRobot();
  if (robot)
    if (const Status written = robot->Write(); !written) Drop(written.error().message);
  TakeNewcomers();
}

void RobotSocket::Impl::TakeNewcomers() {
  std::array<pollfd, 1> waiting{{{listener.fd(), POLLIN, 0}}};
  while (::poll(waiting.data(), 1, 0) > 0) {
    UniqueFd fd = listener.Accept();
    if (!fd.IsOpen()) {  // no descriptors left, say: trying at once again would take a whole core
      listener_rests = true;
      return;
    }
    HearRobot();  // one that went before the newcomer came leaves its place
    if (robot) {
      (void)RobotConnection(std::move(fd)).WriteLine(kTaken);
      continue;
    }
    robot.emplace(std::move(fd));
    stray_lines = 0;
    robot_is_there = true;
    LogInfo("robot: connected to {}", listener.path().native());
  }
}

/// All that it has said; ends, because too many lines and too long ones drop the robot.
void RobotSocket::Impl::HearRobot() {
  while (robot && robot->HasMoreToRead()) ReadRobot();
}

void RobotSocket::Impl::ReadRobot() {
  const auto lines = robot->ReadLines();
  if (!lines) return Drop(lines.error().message);
  for (const std::string& line : *lines) {
    OnLine(line);
    if (stray_lines > kMostStrayLines)
      return Drop(fmt::format("robot: {} lines that answer no pose", stray_lines));
  }
}

void RobotSocket::Impl::OnLine(const std::string& line) {
  Result<RobotLine> answer = RobotLineFromJson(line);
  if (answer && question && answer->id == question->id)
    return Answer(answer->answer.kind, std::move(answer->answer.reason));
  ++stray_lines;
  last_trouble = answer ? "robot: it answers another pose" : answer.error().message;
}

void RobotSocket::Impl::BeginQuestion() {
  {
    const std::lock_guard lock(mutex);
    if (asked == nullptr || asked->answer || question) return;
  }
  Service();  // who connected or went before the pose came counts
  question = asked;
  if (!robot) return Answer(Kind::kNobodyThere, NobodyThere());
  stray_lines = 0;
  last_trouble.clear();
  deadline = Clock::now() + timeout;
  if (const Status written = robot->WriteLine(question->line); !written)
    Drop(written.error().message);
}

void RobotSocket::Impl::EndLateQuestion() {
  if (!question || Clock::now() < deadline) return;
  const double seconds = 1e-3 * static_cast<double>(timeout.count());
  if (robot && robot->HasMoreToWrite()) {  // half a line would spoil the next one
    Disconnect("robot: does not read");
    return Answer(
        Kind::kNoAnswer,
        fmt::format("The robot did not read the pose within {} s: its connection was closed.",
                    seconds));
  }
  Answer(Kind::kNoAnswer,
         fmt::format("The robot did not answer within {} s; it may have got the pose.{}", seconds,
                     last_trouble.empty() ? "" : " What it said last: " + last_trouble + "."));
}

void RobotSocket::Impl::Answer(Kind kind, std::string reason) {
  if (!question) return;
  const std::lock_guard lock(mutex);
  question->answer = RobotAnswer{kind, std::move(reason)};
  question = nullptr;
  answered.notify_all();
}

void RobotSocket::Impl::Disconnect(const std::string& why) {
  LogInfo("{}", why);
  robot.reset();
  robot_is_there = false;
}

void RobotSocket::Impl::Drop(const std::string& why) {
  const bool had_all = robot && !robot->HasMoreToWrite();
  Disconnect(why);  // before the answer: who gets it finds the robot gone
  if (had_all)
    Answer(Kind::kNoAnswer,
           fmt::format("The connection to the robot ended before it answered ({}); it may have got "
                       "the pose.",
                       why));
  else
    Answer(Kind::kNobodyThere, NobodyThere());
}

std::string RobotSocket::Impl::NobodyThere() const {
  return fmt::format("No robot is connected to {}.", listener.path().native());
}

Status RobotSocketOptions::Check() const {
  if (answer_timeout >= milliseconds(1) && answer_timeout <= milliseconds(60'000)) return {};
  return Fail(ErrorCode::kInvalidOptions, "answer_timeout is {} ms, not 1 to 60000",
              answer_timeout.count());
}

Result<std::filesystem::path> DefaultRobotSocketPath() {
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  if (folder == nullptr || *folder == '\0')
    return Fail(ErrorCode::kInvalidOptions,
                "robot: XDG_RUNTIME_DIR is not set. Set it, or give the socket's path");
  return std::filesystem::path(folder) / "foresight" / "robot.sock";
}

RobotSocket::RobotSocket(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  impl_->thread = std::thread([this] { impl_->Run(); });
}

RobotSocket::~RobotSocket() {
  impl_->stopping = true;
  impl_->wake.Raise();
  impl_->thread.join();
}

Result<std::unique_ptr<RobotSocket>> RobotSocket::Listen(const RobotSocketOptions& options) {
  FORESIGHT_CHECK(options.Check());
  std::filesystem::path path = options.path;
  if (path.empty()) {
    FORESIGHT_TRY(path, DefaultRobotSocketPath());
  }
  FORESIGHT_TRY(UnixListener listener, UnixListener::Listen(path));
  return std::unique_ptr<RobotSocket>(
      new RobotSocket(std::make_unique<Impl>(std::move(listener), options.answer_timeout)));
}

const std::filesystem::path& RobotSocket::path() const {
  return impl_->listener.path();
}

bool RobotSocket::RobotIsThere() const {
  return impl_->robot_is_there;
}

RobotAnswer RobotSocket::Send(const PoseMessage& message) {
  const std::lock_guard one(impl_->one_sender);
  Question question{message.Id(), PoseMessageToJson(message) + '\n'};
  std::unique_lock lock(impl_->mutex);
  impl_->asked = &question;
  impl_->wake.Raise();
  impl_->answered.wait(lock, [&] { return question.answer.has_value(); });
  impl_->asked = nullptr;
  return *question.answer;
}

}  // namespace foresight
