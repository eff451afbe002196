#include "ui/viewmodels/notes_model.h"

#include <QCoreApplication>
#include <QDateTime>
#include <algorithm>

#include "core/base/utc_text.h"
#include "core/measure/measurement_json.h"
#include "core/mission/new_records.h"

namespace foresight {
namespace {

const QString kNoteTopic = QStringLiteral("note");

/// Texts that lupdate finds under this name.
struct NoteTexts {
  Q_DECLARE_TR_FUNCTIONS(NoteTexts)
};

ShownNote Shown(const NoteRecord& record) {
  ShownNote note{record, std::nullopt};
  if (record.kind == kMeasurementKind)
    if (auto measured = MeasurementFromJson(record.json)) note.measurement = std::move(*measured);
  return note;
}

}  // namespace

const ShownNote* NotesModel::Find(const std::string& uuid) const {
  for (const ShownNote& note : notes_)
    if (note.record.uuid == uuid) return &note;
  return nullptr;
}

void NotesModel::Show(const std::vector<NoteRecord>& records) {
  undo_->Forget(kNoteTopic);
  notes_.clear();
  for (const NoteRecord& record : records)
    if (!record.deleted) notes_.push_back(Shown(record));
  if (Selected() == nullptr) selected_.clear();
  Q_EMIT changed();
}

void NotesModel::Put(const NoteRecord& record) {
  const auto at = std::find_if(notes_.begin(), notes_.end(), [&](const ShownNote& note) {
    return note.record.uuid == record.uuid;
  });
  if (record.deleted) {
    if (at != notes_.end()) notes_.erase(at);
  } else if (at != notes_.end()) {
    *at = Shown(record);
  } else {
    const auto later = std::find_if(notes_.begin(), notes_.end(), [&](const ShownNote& note) {
      return note.record.made_utc_ns > record.made_utc_ns;
    });
    notes_.insert(later, Shown(record));
  }
}

void NotesModel::PutAndKeep(NoteRecord record) {
  record.utc_ns = NowUtc_ns();
  record.author = OperatorName();
  Put(record);
  Q_EMIT touched(record);
  Q_EMIT changed();
}

Status NotesModel::Add(NoteRecord record) {
  FORESIGHT_TRY(record.tags, TagsFrom(record.tags));
  record.uuid = NewUuid();
  record.made_utc_ns = NowUtc_ns();
  record.made_by = OperatorName();
  record.deleted = false;
  NoteRecord gone = record;
  gone.deleted = true;
  undo_->Push(
      record.kind == kMeasurementKind ? NoteTexts::tr("Measure") : NoteTexts::tr("Add note"),
      kNoteTopic, [this, gone] { PutAndKeep(gone); }, [this, record] { PutAndKeep(record); });
  selected_ = record.uuid;
  PutAndKeep(std::move(record));
  return {};
}

Status NotesModel::Change(const std::string& uuid, const std::string& text,
                          const std::string& tags) {
  const ShownNote* note = Find(uuid);
  if (note == nullptr) return {};
  const NoteRecord before = note->record;
  NoteRecord after = before;
  FORESIGHT_TRY(after.tags, TagsFrom(tags));
  after.text = text;
  if (after.text == before.text && after.tags == before.tags) return {};
  undo_->Push(
      NoteTexts::tr("Change note"), kNoteTopic, [this, before] { PutAndKeep(before); },
      [this, after] { PutAndKeep(after); });
  PutAndKeep(after);
  return {};
}

void NotesModel::Remove(const std::string& uuid) {
  const ShownNote* note = Find(uuid);
  if (note == nullptr) return;
  const NoteRecord before = note->record;
  NoteRecord gone = before;
  gone.deleted = true;
  undo_->Push(
      NoteTexts::tr("Delete note"), kNoteTopic, [this, before] { PutAndKeep(before); },
      [this, gone] { PutAndKeep(gone); });
  PutAndKeep(gone);
}

void NotesModel::Select(const std::string& uuid) {
  selected_ = uuid;
  Q_EMIT changed();
  const ShownNote* note = Selected();
  if (note == nullptr) return;
  if (!note->record.scan_uuid.empty())
    Q_EMIT scanWanted(QString::fromStdString(note->record.scan_uuid));
  if (note->measurement)
    Q_EMIT centreWanted(LabelPlace(*note->measurement), note->measurement->frame);
}

QString NameOf(MeasureKind kind) {
  switch (kind) {
    case MeasureKind::kPoint:
      return NoteTexts::tr("Point");
    case MeasureKind::kDistance:
      return NoteTexts::tr("Distance");
    case MeasureKind::kAngle:
      return NoteTexts::tr("Angle");
    case MeasureKind::kPlaneDistance:
      return NoteTexts::tr("Distance to plane");
    case MeasureKind::kHeight:
      break;
  }
  return NoteTexts::tr("Height above ground");
}

QString TextOf(const ShownNote& note) {
  QString text = QString::fromStdString(note.record.text);
  if (note.measurement) {
    const QString value = NameOf(note.measurement->kind) + QLatin1Char(' ') +
                          QString::fromStdString(ValueText(*note.measurement));
    text = text.isEmpty() ? value : text + QStringLiteral(": ") + value;
  }
  for (const QString& tag :
       QString::fromStdString(note.record.tags).split(QLatin1Char(' '), Qt::SkipEmptyParts))
    text += QStringLiteral(" #") + tag;
  return text;
}

QString DetailsOf(const ShownNote& note) {
  QStringList lines;
  if (note.measurement) {
    const bool in_map = note.measurement->frame == MeasureFrame::kMap;
    for (const MeasuredPoint& point : note.measurement->points) {
      QString origin = QString::fromStdString(OriginText(point));
      if (in_map)
        origin += NoteTexts::tr(" of scan %1").arg(QString::fromStdString(point.scan_uuid).left(8));
      lines << NoteTexts::tr("(%1, %2, %3) m in the %4 frame: %5")
                   .arg(point.position_m.x(), 0, 'f', 3)
                   .arg(point.position_m.y(), 0, 'f', 3)
                   .arg(point.position_m.z(), 0, 'f', 3)
                   .arg(in_map ? NoteTexts::tr("map's") : NoteTexts::tr("robot's"), origin);
    }
    if (const auto& plane = note.measurement->plane)
      lines << NoteTexts::tr("Plane of %1: %2 of %3 points, %4 mm rms")
                   .arg(QString::fromStdString(plane->made_from))
                   .arg(plane->inliers)
                   .arg(plane->points)
                   .arg(1e3 * plane->rms_m, 0, 'f', 1);
  }
  const QString when = QDateTime::fromMSecsSinceEpoch(note.record.made_utc_ns / 1'000'000)
                           .toString(QStringLiteral("yyyy-MM-dd HH:mm:ss"));
  lines << NoteTexts::tr("By %1, %2").arg(QString::fromStdString(note.record.made_by), when);
  return lines.join(QLatin1Char('\n'));
}

}  // namespace foresight
