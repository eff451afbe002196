#include "app/ctl/choose_object.h"

namespace foresight {

Result<DetectionRecord> ChooseObject(const MissionFile& mission, const std::string& wanted) {
  FORESIGHT_TRY(const std::vector<DetectionRecord> objects, mission.ListDetections());
  for (const DetectionRecord& object : objects)
    if (object.uuid == wanted || fmt::format("{}", object.id) == wanted) return object;
  return Fail(ErrorCode::kInvalidInput,
              "{}: there is no object {}; foresightctl mission show lists them",
              mission.path().string(), wanted);
}

}  // namespace foresight
