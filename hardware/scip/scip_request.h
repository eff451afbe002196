#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace foresight {

/// What a SCIP 2.2 device can be asked.
enum class ScipCommand {
  kVersion,          ///< VV
  kParameters,       ///< PP
  kState,            ///< II
  kLaserOn,          ///< BM
  kQuit,             ///< QT: stop and laser off, also leaves time mode
  kReset,            ///< RS: defaults, clock to 0
  kReboot,           ///< RB: takes effect when sent twice within a second
  kEnterTime,        ///< TM0
  kReadTime,         ///< TM1
  kLeaveTime,        ///< TM2
  kStream,           ///< MD
  kStreamIntensity,  ///< ME
  kStreamEchoes,     ///< ND
  kStreamAll,        ///< NE: echoes with intensity
  kSingle,           ///< GD: the newest scan, once
  kSingleIntensity,  ///< GE
  kSingleEchoes,     ///< HD
  kSingleAll,        ///< HE
};

/// Two letters, three with TM's digit.
std::string_view ToText(ScipCommand command);
/// MD ME ND NE.
bool IsStream(ScipCommand command);
/// GD GE HD HE.
bool IsSingle(ScipCommand command);
bool HasIntensity(ScipCommand command);
bool HasEchoes(ScipCommand command);

/// One request. Also the echo of one: in a stream's scans `count` is the number still to come.
struct ScipRequest {
  static constexpr std::size_t kLongestTag = 16;

  ScipCommand command = ScipCommand::kVersion;
  // Of scans only:
  int first_step = 0;
  int last_step = 1080;
  int group = 1;  ///< steps per value; 0 means 1
  int skip = 0;   ///< scans left out after each one; streams only
  int count = 0;  ///< 0 = endless; streams only

  std::string tag = {};  ///< comes back in every reply; empty = none

  /// Values of a scan.
  int Values() const;

  bool operator==(const ScipRequest&) const = default;
};

/// Without the final line feed. The request is valid: steps and group fit their digits.
std::string EncodeScipRequest(const ScipRequest& request);
/// `line` without its end; the error is the status a device answers with.
tl::expected<ScipRequest, std::string> ParseScipRequest(std::string_view line);

}  // namespace foresight
