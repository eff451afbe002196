#pragma once

#include <QMap>
#include <QString>
#include <QStringList>
#include <vector>

#include "core/exchange/assemble_scan.h"

namespace foresight {

/// What is imported; each kind has options of its own, and an operator's choices are remembered for
/// each.
enum class ImportKind { kCloud, kKitti, kBag };
/// By the names of the files: a bag among them makes it one, KITTI's .bin comes next.
ImportKind ImportKindOf(const QStringList& files);
/// "cloud", "kitti", "bag"; for the settings.
QString KeyOf(ImportKind kind);

/// One option of `foresightctl mission import`, as an operator is asked for it.
struct ImportField {
  QString key;  ///< as the command names it, without its dashes
  QString title;
  QString tip;
  QStringList values;  ///< to choose from, the default first; empty = any text
};
std::vector<ImportField> ImportFieldsOf(ImportKind kind);

/// Texts by the keys of fields; what is empty or missing is taken from the files, or assumed.
using ImportChoices = QMap<QString, QString>;
/// Fails with kInvalidOptions, naming the field at fault, and as LoadSensorRig does.
Result<ImportOptions> ImportOptionsFrom(const ImportChoices& choices);

}  // namespace foresight
