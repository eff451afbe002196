#include "core/mission/record_events.h"

#include <nlohmann/json.hpp>

namespace foresight {

Status ReadRecordEvents(const MissionFile& file, const char* what,
                        const std::function<bool(const EventRecord&)>& wanted,
                        const std::function<void(const EventRecord&)>& read) {
  FORESIGHT_TRY(const std::vector<EventRecord> events, file.ListEvents());
  for (const EventRecord& event : events) {
    if (!wanted(event)) continue;
    try {
      read(event);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& fault) {
      return Fail(ErrorCode::kBadData, "{}: event {}: {}: {}", file.path().string(), event.id, what,
                  fault.what());
    }
  }
  return {};
}

std::string RecordEventJson(const nlohmann::ordered_json& record) {
  return record.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace foresight
