#include "core/fitting/terrain/terrain_detection.h"

namespace foresight {

const char* ToString(TerrainSurface::Kind kind) {
  switch (kind) {
    case TerrainSurface::Kind::kBlock:
      return "block";
    case TerrainSurface::Kind::kGround:
      return "ground";
    case TerrainSurface::Kind::kUnknown:
      return "unknown";
  }
  return "unknown";
}

}  // namespace foresight
