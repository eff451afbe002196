#pragma once

#include <QColor>
#include <QIcon>

class QApplication;

namespace foresight {

/// The calm dark look of the workstation: palette, type and the few rules that a palette cannot
/// express. Colours of states are those of Okabe and Ito, told apart also by the colour-blind.
void ApplyTheme(QApplication* application);

/// An icon of resources/icons by its name, e.g. "scan".
QIcon Icon(const char* name);

namespace state_color {
inline const QColor kGood(0, 158, 115);     ///< bluish green
inline const QColor kCaution(230, 159, 0);  ///< orange
inline const QColor kBad(213, 94, 0);       ///< vermillion
inline const QColor kActive(86, 180, 233);  ///< sky blue
inline const QColor kNeutral(132, 140, 150);
}  // namespace state_color

}  // namespace foresight
