#include "app/ctl/mission_beside.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace foresight {

Result<std::unique_ptr<MissionFile>> MissionBeside(const MissionFile& mission) {
  if (!mission.IsReview()) return nullptr;
  constexpr std::string_view kEnding = ".review.foresight";
  const std::string review = mission.path().string();
  const std::string stem =
      review.substr(0, review.size() - std::min(review.size(), kEnding.size()));
  for (const char* ending : {".foresight", ""})
    if (std::error_code ignored; std::filesystem::exists(stem + ending, ignored))
      return MissionFile::OpenReadOnly(stem + ending);
  return Fail(ErrorCode::kIo, "{}: the mission {}.foresight is not beside it", review, stem);
}

}  // namespace foresight
