#pragma once

#include <optional>

#include "hardware/link/chunks/chunk_order.h"
#include "sensor_head.pb.h"

namespace foresight {

link::Chunk ToMessage(Chunk chunk);
/// Takes the bytes out of the message. nullopt where a newer head has a kind that this program does
/// not know; everything else is checked by CheckChunk.
std::optional<Chunk> FromMessage(link::Chunk&& message);

/// What makes no sense (a region that ends before it begins, too many images) is left out.
TransferPreferences FromMessage(const link::TransferPreferences& message);

}  // namespace foresight
