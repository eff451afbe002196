#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/mission/mission_file.h"

namespace foresight {

/// Records without a table of their own are events of a mission whose JSON holds the record: their
/// source says which kind it is.

/// Calls `read` with each event that `wanted` chooses, the oldest first. What `read` throws becomes
/// kBadData: "FILE: event N: WHAT: the fault". Fails as MissionFile::ListEvents does.
Status ReadRecordEvents(const MissionFile& file, const char* what,
                        const std::function<bool(const EventRecord&)>& wanted,
                        const std::function<void(const EventRecord&)>& read);

/// The JSON of such an event. Bytes that are no UTF-8, as a file's name may have, are replaced.
std::string RecordEventJson(const nlohmann::ordered_json& record);

}  // namespace foresight
