#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/simulation/world.h"

namespace foresight {

/// What became of one board of a mount in one image.
struct BoardSearchOutcome {
  std::string image;
  char board = 'A';
  bool whole = false;  ///< all of its squares are in the image, and nothing covers a corner
  bool found = false;
  /// Of the corner that is farthest from where it is, if the board was found.
  double worst_px = std::numeric_limits<double>::quiet_NaN();

  /// Squares are wider than that, so a grid of other corners is not.
  bool Right() const { return found && worst_px < 3.0; }
  bool Wrong() const { return found && !Right(); }
};

struct BoardSearchTrial {
  std::vector<BoardSearchOutcome> boards;
  double search_s = 0.0;  ///< of all images one after the other, without reading them
};

struct BoardSearchTrialOptions {
  /// Half of the boards get a cover: a disc on the squares, or a strip over one side.
  bool cover = false;
  std::uint64_t cover_seed = 1;
};

/// Looks for the boards of a mount in the stops' images of a session that was recorded in `world`,
/// one image after the other, and compares them with the truth. Poses have the names of the scene's
/// places. That one board may hide the other is not known here. Fails with kIo, kBadData.
Result<BoardSearchTrial> RunBoardSearchTrial(const std::filesystem::path& session,
                                             const World& world,
                                             const BoardSearchTrialOptions& options,
                                             const RunContext& context);

}  // namespace foresight
