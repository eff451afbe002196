#pragma once

#include <memory>
#include <string>

#include "app/common/link_arguments.h"
#include "core/base/run_context.h"
#include "hardware/api/sensor_head.h"

namespace foresight {

class RemoteHead;
class ScanArchive;

/// Stops the head's motor by a connection of its own, without taking control; waits a minute for
/// the answer. Fails as foresight::StopHead() does, and where the keys cannot be used.
Result<HeadStatus> StopHeadAt(const LinkArguments& arguments, const RunContext& context);

/// What a program wants of a head. Who only reads leaves control where it is, also with an operator
/// of the same name whose window has it.
enum class HeadUse { kOperate, kRead };

/// Connects to the head. `spool` is the folder for what has come of scans that are not whole; empty
/// = the user's.
Result<std::shared_ptr<RemoteHead>> ConnectHead(const LinkArguments& arguments, HeadUse use,
                                                std::shared_ptr<ScanArchive> archive,
                                                const std::string& spool = "");
/// To read from the head what is no scan.
Result<std::shared_ptr<RemoteHead>> LookAtHead(const LinkArguments& arguments);

}  // namespace foresight
