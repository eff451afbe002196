#pragma once

#include <string>

#include "core/objects/calibration_board.h"

namespace foresight {

/// A page as printers have it.
struct Paper {
  std::string name = "A4";
  double width_mm = 297.0;  ///< the long side across
  double height_mm = 210.0;
};
/// "A4", "A3", "A2", "A1", "A0" (the long side across, as boards lie), or "WIDTHxHEIGHT" in mm;
/// "fit" is as large as the board needs. Fails with kInvalidOptions.
Result<Paper> PaperFromText(const std::string& text, const CalibrationBoard& board);

/// The board in its true size on one page, as PDF, with what it is in words, a frame of its
/// quiet zone, and a ruler of 100 mm on two sides to check the print with. The board lies in the
/// middle. Fails with kInvalidOptions where it does not fit on the paper.
Result<std::string> BoardPdf(const CalibrationBoard& board, const Paper& paper);

/// A drawing, for whoever builds it, of two boards at a right angle on one mount: sizes in mm, the
/// hinge along the boards' short sides, and how to hold it. One A4 page, not to scale.
Result<std::string> TwoBoardMountPdf(const CalibrationBoard& board);

}  // namespace foresight
