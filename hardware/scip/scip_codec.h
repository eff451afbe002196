#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "hardware/scip/scip_parser.h"
#include "hardware/scip/scip_request.h"

namespace foresight {

/// One echo of one step. A range below the device's DMIN is a code: 1 no echo, 2 too near,
/// 3 interference, 4 out of range at the near end, 5 other.
struct ScipEcho {
  std::uint32_t range_mm = 0;   ///< 18 bits
  std::uint32_t intensity = 0;  ///< 18 bits; 0 where the command has none

  bool operator==(const ScipEcho&) const = default;
};

/// The echoes of one step, in the device's order: the nearest first.
struct ScipStep {
  static constexpr std::size_t kMostEchoes = 3;

  std::array<ScipEcho, kMostEchoes> echoes;
  std::size_t count = 1;

  bool operator==(const ScipStep&) const = default;
};

struct ScipScan {
  ScipRequest request;         ///< with the number of scans still to come
  std::uint32_t stamp_ms = 0;  ///< 24 bits; of step 0
  std::vector<ScipStep> steps;

  bool operator==(const ScipScan&) const = default;
};

/// What PP says of a device.
struct ScipParameters {
  std::string model;
  int min_range_mm = 23;        ///< DMIN
  int max_range_mm = 60000;     ///< DMAX
  int steps_per_turn = 1440;    ///< ARES
  int first_step = 0;           ///< AMIN
  int last_step = 1080;         ///< AMAX
  int front_step = 540;         ///< AFRT
  double turns_per_min = 2400;  ///< SCAN

  bool operator==(const ScipParameters&) const = default;
};

/// `KEY:VALUE` lines of VV, PP and II.
using ScipInfo = std::map<std::string, std::string>;

// Replies to messages. All fail with kBadData, saying which line is damaged.
/// Fails with kInvalidInput where all sums are right and the number of steps is not the request's.
Result<ScipScan> DecodeScipScan(const ScipReply& reply);
Result<ScipInfo> DecodeScipInfo(const ScipReply& reply);
Result<ScipParameters> DecodeScipParameters(const ScipInfo& info);
/// Milliseconds of TM1, 24 bits.
Result<std::uint32_t> DecodeScipTime(const ScipReply& reply);

// Messages to the bytes of whole replies.
std::string EncodeScipReply(std::string_view echo, std::string_view status);
std::string EncodeScipScan(const ScipScan& scan);
std::string EncodeScipInfo(std::string_view echo,
                           std::span<const std::pair<std::string, std::string>> fields);
std::string EncodeScipTime(std::string_view echo, std::uint32_t stamp_ms);
/// The lines of a PP reply.
std::vector<std::pair<std::string, std::string>> ToFields(const ScipParameters& parameters);

}  // namespace foresight
