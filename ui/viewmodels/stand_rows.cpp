#include "ui/viewmodels/stand_rows.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace foresight {
namespace {

/// A stop whose corners fit this many times worse than the median stands out.
constexpr double kStandsOut = 3.0;

StopLamp LampOf(const StandRowsSource& source, const SessionStopFiles& stop, int number) {
  using State = StopLamp::State;
  StopLamp lamp;
  lamp.motor_rad = stop.motor_rad;
  lamp.number = number;
  lamp.has_lines = !stop.lines.empty() && !stop.lines_excluded;
  if (stop.excluded || stop.view.excluded) {
    lamp.state = State::kExcluded;
    return lamp;
  }
  if (stop.view.empty()) {
    lamp.state = State::kNoImage;
    return lamp;
  }
  const MountView* view = FoundIn(source.found->stops, stop.view.File());
  if (view == nullptr) {
    lamp.state = State::kLooking;
    return lamp;
  }
  const bool whole = view->a && (view->b || !source.index->mount.b);
  lamp.fault = QString::fromStdString(view->fault);
  lamp.state = view->empty() ? State::kNoBoard : whole ? State::kBothBoards : State::kOneBoard;
  if (source.solution != nullptr)
    if (const auto rms = source.solution->rms_px.find(view->source);
        rms != source.solution->rms_px.end())
      lamp.rms_px = rms->second;
  return lamp;
}

/// The captures of a place; one that another took the place of is not shown.
StandPlaceRow RowOf(const StandRowsSource& source, const SessionPoseFiles& pose) {
  StandPlaceRow row{.name = QString::fromStdString(pose.name), .excluded = pose.excluded};
  for (std::size_t k = 0; k < pose.stops.size(); ++k) {
    const bool replaced =
        pose.stops[k].excluded &&
        std::any_of(pose.stops.begin(), pose.stops.end(), [&](const SessionStopFiles& other) {
          return !other.excluded && SameStop(other.motor_rad, pose.stops[k].motor_rad);
        });
    if (!replaced) row.stops.push_back(LampOf(source, pose.stops[k], static_cast<int>(k)));
  }
  for (std::size_t k = 0; k < pose.sweeps.size(); ++k) {
    row.sweep_number = static_cast<int>(k);
    row.sweep =
        pose.sweeps[k].excluded ? StandPlaceRow::Sweep::kExcluded : StandPlaceRow::Sweep::kThere;
    if (!pose.sweeps[k].excluded) break;
  }
  return row;
}

void AddPlanned(const std::vector<double>& planned_rad, StandPlaceRow* row) {
  for (const double angle : planned_rad) {
    const auto same = [&](const StopLamp& lamp) { return SameStop(lamp.motor_rad, angle); };
    if (std::none_of(row->stops.begin(), row->stops.end(), same))
      row->stops.push_back({.motor_rad = angle});
  }
}

void MarkThoseThatStandOut(std::vector<StandPlaceRow>* rows) {
  std::vector<double> all_rms;
  for (const StandPlaceRow& row : *rows)
    for (const StopLamp& lamp : row.stops)
      if (std::isfinite(lamp.rms_px)) all_rms.push_back(lamp.rms_px);
  if (all_rms.empty()) return;
  const double median = UpperMedian(std::move(all_rms));
  for (StandPlaceRow& row : *rows)
    for (StopLamp& lamp : row.stops) lamp.stands_out = lamp.rms_px > kStandsOut * median;
}

}  // namespace

const MountView* FoundIn(const std::map<std::string, MountView>& views, const std::string& file) {
  const auto at = views.find(file);
  return at == views.end() ? nullptr : &at->second;
}

bool SameStop(double a_rad, double b_rad) {
  return std::abs(a_rad - b_rad) < kSameStop_rad;
}

std::vector<StandPlaceRow> StandPlaceRows(const StandRowsSource& source) {
  std::vector<StandPlaceRow> rows;
  const auto& poses = source.index->poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    StandPlaceRow row = RowOf(source, poses[i]);
    if (static_cast<int>(i) == source.present_place && source.solution == nullptr)
      AddPlanned(source.planned_rad, &row);
    std::stable_sort(row.stops.begin(), row.stops.end(),
                     [](const auto& a, const auto& b) { return a.motor_rad < b.motor_rad; });
    rows.push_back(std::move(row));
  }
  MarkThoseThatStandOut(&rows);
  return rows;
}

std::vector<BoardImageRow> BoardImageRows(const StandRowsSource& source) {
  using State = BoardImageRow::State;
  std::vector<BoardImageRow> rows;
  for (const SessionViewFiles& view : source.index->intrinsic_views) {
    BoardImageRow row{.file = QString::fromStdString(view.File()),
                      .origin = QString::fromStdString(view.origin)};
    const MountView* found = FoundIn(source.found->intrinsic, view.File());
    if (view.excluded)
      row.state = State::kExcluded;
    else if (found != nullptr)
      row.state = found->a ? State::kUsed : State::kNoBoard;
    if (row.state == State::kNoBoard) row.fault = QString::fromStdString(found->fault);
    if (source.solution != nullptr && row.state == State::kUsed) {
      const auto rms = source.solution->rms_px.find(found->source);
      if (rms != source.solution->rms_px.end())
        row.rms_px = rms->second;
      else if (source.stage == CalibrationStage::kAll)
        row.state = State::kLeftOut;
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace foresight
