#pragma once

#include <Eigen/Core>
#include <QObject>
#include <QString>
#include <optional>
#include <string>
#include <vector>

#include "core/measure/measurement.h"
#include "core/mission/mission_records.h"
#include "ui/viewmodels/undo_stack.h"

namespace foresight {

/// A note or a measurement of a document.
struct ShownNote {
  NoteRecord record;
  std::optional<Measurement> measurement;  ///< of one that is a measurement
};

/// What was written down and measured in a document: of all its scans, its objects, and of the
/// mission. What is done can be undone; `touched` asks for it to be kept.
class NotesModel : public QObject {
  Q_OBJECT

 public:
  explicit NotesModel(UndoStack* undo, QObject* parent = nullptr) : QObject(parent), undo_(undo) {}

  /// Those that are not deleted, in the order in which they were made.
  const std::vector<ShownNote>& All() const { return notes_; }
  const ShownNote* Find(const std::string& uuid) const;
  /// The note that is looked at; nullptr = none.
  const ShownNote* Selected() const { return Find(selected_); }

  /// Notes out of a file, in place of those that are listed; deleted ones may be among them.
  void Show(const std::vector<NoteRecord>& records);
  /// A new one, selected at once. Fails with kInvalidInput for tags that are none. Uuid, time and
  /// author are filled in.
  Status Add(NoteRecord record);
  /// Another text, or name, and other tags. Fails as Add.
  Status Change(const std::string& uuid, const std::string& text, const std::string& tags);
  void Remove(const std::string& uuid);
  /// Selects it; the panes are asked to show where it is.
  void Select(const std::string& uuid);

 public Q_SLOTS:
  void removeSelected() { Remove(selected_); }

 Q_SIGNALS:
  void changed();
  /// It got a new state, which is to be kept.
  void touched(const foresight::NoteRecord& record);
  /// Its middle is to be seen, in robot of its scan or in map.
  void centreWanted(const Eigen::Vector3d& place, foresight::MeasureFrame frame);
  /// It is of a scan that is not shown.
  void scanWanted(const QString& scan_uuid);

 private:
  void Put(const NoteRecord& record);
  void PutAndKeep(NoteRecord record);

  UndoStack* undo_;
  std::vector<ShownNote> notes_;
  std::string selected_;
};

/// "distance 1.234 m ± 12 mm", "note: the rim is bent #crack".
QString TextOf(const ShownNote& note);
/// Where the points of a measurement come from, its plane, who made it and when.
QString DetailsOf(const ShownNote& note);
/// "Distance", "Distance to plane", ...
QString NameOf(MeasureKind kind);

}  // namespace foresight

Q_DECLARE_METATYPE(foresight::NoteRecord)
