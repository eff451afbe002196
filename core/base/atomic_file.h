#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

/// The file that writing to `path` would replace: `path` itself, or what it points to where it is a
/// symbolic link, even to a file that is not there yet. Fails with kIo for what exists and is no
/// regular file (a folder, a device, a pipe, a socket: replacing one would break it for everybody
/// else), and for links that lead in a circle or to an open stream (/dev/stdout).
Result<std::filesystem::path> ResolveOutput(const std::filesystem::path& path);

/// Writes the whole file or nothing: to a neighbour first, which reaches the disk and is then
/// renamed over the file that `path` names. Symbolic links stay and keep pointing to the file; a
/// file that is replaced keeps its permissions. It is on the disk when the call returns. Fails with
/// kIo, as ResolveOutput does.
Status WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// Waits until the file's bytes, or the names in the folder that holds `path`, are on the disk.
/// Fails with kIo.
Status SyncFile(const std::filesystem::path& path);
Status SyncFolderOf(const std::filesystem::path& path);

/// Adds to the end of a file, which is made where there is none; for tables that grow. A write that
/// fails may leave a part of `bytes`. Fails with kIo, as ResolveOutput does.
Status AppendToFile(const std::filesystem::path& path, std::string_view bytes);

/// The whole file. Fails with kIo, also for what is no regular file (a pipe without a writer would
/// be waited for, a device never ends) and where memory does not suffice; with kBadData when it is
/// larger than `limit_bytes`.
Result<std::string> ReadFile(const std::filesystem::path& path,
                             std::size_t limit_bytes = std::size_t{1} << 31);

}  // namespace foresight
