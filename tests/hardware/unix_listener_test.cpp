#include "hardware/net/unix_listener.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cstring>
#include <fstream>

#include "hardware/net/poll_fd.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

/// A socket file as a program leaves it that was killed.
void LeaveSocketFile(const std::filesystem::path& path) {
  const UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, path.c_str());
  ASSERT_EQ(::bind(fd.Get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::listen(fd.Get(), 1), 0);
}

mode_t RightsOf(const std::filesystem::path& path) {
  struct stat found {};
  EXPECT_EQ(::stat(path.c_str(), &found), 0);
  return found.st_mode & 0777;
}

TEST(UnixListener, TakesAConnectionAndCarriesBytes) {
  const TemporaryFolder folder;
  const UnixListener listener = UnixListener::Listen(folder / "s").value();
  EXPECT_FALSE(listener.Accept().IsOpen()) << "nobody has connected";
  const UniqueFd client = ConnectUnix(folder / "s").value();
  ASSERT_TRUE(PollFd(listener.fd(), POLLIN, std::chrono::seconds(10), nullptr));
  const UniqueFd server = listener.Accept();
  ASSERT_TRUE(server.IsOpen());
  EXPECT_EQ(::send(client.Get(), "a", 1, MSG_NOSIGNAL), 1);
  char byte = 0;
  EXPECT_EQ(::recv(server.Get(), &byte, 1, 0), 1);
  EXPECT_EQ(byte, 'a');
}

TEST(UnixListener, TheFileIsForUserAndGroupAndGoesWithTheListener) {
  const TemporaryFolder folder;
  {
    const UnixListener listener = UnixListener::Listen(folder / "new" / "s").value();
    EXPECT_EQ(RightsOf(folder / "new"), 0700u);
    EXPECT_EQ(RightsOf(folder / "new" / "s"), 0660u);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "new" / "s"));
  EXPECT_THAT(ConnectUnix(folder / "new" / "s").error().message, HasSubstr("No such file"));
}

TEST(UnixListener, ASocketThatSomebodyListensOnIsLeftToHim) {
  const TemporaryFolder folder;
  const UnixListener first = UnixListener::Listen(folder / "s").value();
  const auto second = UnixListener::Listen(folder / "s");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kIo);
  EXPECT_THAT(second.error().message, HasSubstr("another program listens there"));
  EXPECT_TRUE(ConnectUnix(folder / "s")) << "the first one goes on";
}

TEST(UnixListener, AForeignListenerIsLeftAloneToo) {
  const TemporaryFolder folder;
  const UnixListener listener = UnixListener::Listen(folder / "s").value();
  std::filesystem::remove(folder / "s.lock");  // as if it had made none
  EXPECT_THAT(UnixListener::Listen(folder / "s").error().message, HasSubstr("another program"));
  EXPECT_TRUE(ConnectUnix(folder / "s"));
}

TEST(UnixListener, AStaleSocketOfACrashedProgramIsTakenOver) {
  const TemporaryFolder folder;
  LeaveSocketFile(folder / "s");
  ASSERT_FALSE(ConnectUnix(folder / "s"));
  const auto listener = UnixListener::Listen(folder / "s");
  ASSERT_TRUE(listener) << listener.error().message;
  EXPECT_TRUE(ConnectUnix(folder / "s"));
}

TEST(UnixListener, AFileOfTheSameNameIsNotRemoved) {
  const TemporaryFolder folder;
  std::ofstream(folder / "s") << "precious";
  EXPECT_THAT(UnixListener::Listen(folder / "s").error().message, HasSubstr("no socket"));
  EXPECT_EQ(std::filesystem::file_size(folder / "s"), 8u);
}

TEST(UnixListener, APathThatIsTooLongIsNamedWithItsLength) {
  const TemporaryFolder folder;
  const auto listener = UnixListener::Listen(folder / std::string(120, 'x'));
  ASSERT_FALSE(listener);
  EXPECT_THAT(listener.error().message, HasSubstr("has 1 to 107 bytes"));
}

TEST(UnixListener, AFolderThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THAT(UnixListener::Listen(folder / "file" / "s").error().message, HasSubstr("file"));
}

}  // namespace
}  // namespace foresight
