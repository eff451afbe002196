#include "ui/viewmodels/map_view_model.h"

#include <array>

namespace foresight {

MapViewModel::MapViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {
  connect(&runner_, &TaskRunner::changed, this, &MapViewModel::changed);
}

QString MapViewModel::WhyNoMap() const {
  return Busy() ? tr("A map is being made.") : QString();
}

void MapViewModel::SetShown(bool shown) {
  if (shown == shown_) return;
  shown_ = shown;
  Q_EMIT shownChanged();
}

void MapViewModel::Make(const QString& mission, const QString& odometry_file) {
  const auto work = [path = mission.toStdString(), poses = odometry_file.toStdString()](
                        const RunContext& context) -> Result<std::shared_ptr<const ShownMap>> {
    MapOdometry odometry;
    if (!poses.empty()) {
      FORESIGHT_TRY(odometry, LoadMapOdometry(poses));
    }
    FORESIGHT_TRY(const auto file, MissionFile::OpenReadOnly(path));
    auto shown = std::make_shared<ShownMap>();
    FORESIGHT_TRY(shown->map, MapMission(*file, {}, odometry, context.Part(0.0, 0.9)));
    FORESIGHT_TRY(shown->pyramid,
                  PointPyramid::Build(PointsOfMap(shown->map), {}, context.Part(0.9, 1.0)));
    return std::shared_ptr<const ShownMap>(std::move(shown));
  };
  runner_.Run<std::shared_ptr<const ShownMap>>(
      tr("Bringing the scans together"), work,
      [this, mission](Result<std::shared_ptr<const ShownMap>> map) {
        if (!map) {
          if (map.error().code != ErrorCode::kCancelled)
            session_->Report(NoticeOf(tr("Bringing the scans together"), map.error()));
          return;
        }
        map_ = std::move(*map);
        mission_ = mission;
        changes_.clear();
        changes_text_.clear();
        Q_EMIT changed();
        Q_EMIT made();
      });
}

void MapViewModel::FindChanges(int before, int after) {
  const auto count = map_ ? static_cast<int>(map_->map.scans.size()) : 0;
  if (before < 0 || after < 0 || before >= count || after >= count || before == after) return;
  const auto work = [map = map_, before, after](const RunContext& context) {
    const auto& scans = map->map.scans;
    return FindChangesInMap(map->map, scans[static_cast<std::size_t>(before)].id,
                            scans[static_cast<std::size_t>(after)].id, {}, context);
  };
  runner_.Run<ScanChanges>(
      tr("Looking for changes"), work, [this, map = map_](const Result<ScanChanges>& found) {
        if (!found) {
          if (found.error().code != ErrorCode::kCancelled)
            session_->Report(NoticeOf(tr("Looking for changes"), found.error()));
          return;
        }
        if (map != map_) return;  // of a map that is gone
        changes_ = found->changes;
        changes_text_ = changes_.empty()
                            ? tr("Nothing has changed.")
                            : tr("%n change(s).", nullptr, static_cast<int>(changes_.size()));
        if (found->not_seen_before > 0)
          changes_text_ +=
              tr(" %1 points lie where the first scan could not see.").arg(found->not_seen_before);
        Q_EMIT changed();
      });
}

std::vector<QString> MapViewModel::PlaceTexts() const {
  std::vector<QString> texts;
  if (!map_) return texts;
  for (const MappedScan& scan : map_->map.scans)
    texts.push_back(QString::fromStdString(PlaceText(scan)));
  for (const std::string& sentence : map_->map.left_out)
    texts.push_back(QString::fromStdString(sentence));
  return texts;
}

void MapViewModel::clear() {
  runner_.cancel();
  map_.reset();
  mission_.clear();
  changes_.clear();
  changes_text_.clear();
  SetShown(false);
  Q_EMIT changed();
}

void MapViewModel::lookAtChange(int index) {
  if (index < 0 || index >= static_cast<int>(changes_.size())) return;
  Q_EMIT centreWanted(changes_[static_cast<std::size_t>(index)].centre);
}

Rgb8 ColorOfScan(std::size_t index) {
  static constexpr std::array<Rgb8, 7> kColors = {{{86, 180, 233},
                                                   {230, 159, 0},
                                                   {0, 158, 115},
                                                   {204, 121, 167},
                                                   {240, 228, 66},
                                                   {213, 94, 0},
                                                   {0, 114, 178}}};
  return kColors[index % kColors.size()];
}

}  // namespace foresight
