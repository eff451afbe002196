#pragma once

namespace foresight {

class Workbench;

/// The rows of the command table that are about missions under review: replay, timeline, closing.
/// None of them is written into the mission that is being recorded.
void AddReviewCommands(Workbench* bench);

}  // namespace foresight
