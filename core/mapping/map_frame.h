#pragma once

namespace foresight::frame {

struct Map {  ///< where the robot stood at the first scan of a map: its `robot` frame then
  static constexpr const char* kName = "map";
};

}  // namespace foresight::frame
