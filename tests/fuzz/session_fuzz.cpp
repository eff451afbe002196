// Calibration sessions. Which of a session's files an input is, its first letters say.
#include <cstdint>

#include "core/calibration/session_file.h"
#include "tests/fuzz/session_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  static SessionFiles files;
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  const std::string name = text.starts_with("board")  ? "corners.csv"
                           : text.starts_with("seq")  ? "lines.csv"
                           : text.starts_with("time") ? "motor.csv"
                                                      : "session.yaml";
  files.Write(name, text);
  RunContext context;
  context.threads = 1;
  const auto session = ReadCalibrationSession(files.path(), context);
  files.Reset();
  if (!session) {
    Require(!session.error().message.empty(), "an error has a message");
    return 0;
  }
  Require(session->Check().has_value(), "a session that was accepted can be calibrated from");
  Require(SessionHash(*session).size() == 64, "a session has a hash");
  return 0;
}
