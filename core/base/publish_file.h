#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace foresight {

/// Gives a file that was written beside its target the target's name, for who cannot write through
/// WriteFileAtomically: `part` reaches the disk, replaces `target` (as ResolveOutput gives it), and
/// the folder reaches the disk too. Where that fails `part` is removed. Fails with kIo.
Status PublishFile(const std::filesystem::path& part, const std::filesystem::path& target);

}  // namespace foresight
