#pragma once

namespace ads {
class CDockManager;
}  // namespace ads

namespace foresight {

/// Which buttons docks have. Call before the dock manager is made.
void SetUpDocks();

/// Dark tabs and frames: the docking library's own style is made for light palettes.
void StyleDocks(ads::CDockManager* docks);

}  // namespace foresight
