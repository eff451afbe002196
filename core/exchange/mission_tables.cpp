#include "core/exchange/mission_tables.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/utc_text.h"
#include "core/detection/candidates.h"
#include "core/detection/detection_json.h"
#include "core/geometry/angles.h"
#include "core/measure/measurement_json.h"
#include "core/mission/provenance.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

/// A value between commas.
std::string Cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}
std::string Cell(const char* text) {
  return Cell(std::string(text));
}
std::string Cell(bool value) {
  return value ? "true" : "false";
}
std::string Cell(std::int64_t value) {
  return fmt::format("{}", value);
}
std::string Cell(double value) {
  return fmt::format("{}", value);
}

template <class... Values>
void AddRow(std::string& csv, const Values&... values) {
  bool first = true;
  ((csv += (first ? "" : ",") + Cell(values), first = false), ...);
  csv += "\r\n";
}

/// "x,y,z,qw,qx,qy,qz" of the answer, in robot; commas alone where there is none.
std::string PoseCells(const Detection& detection, int candidate,
                      const Rigid<frame::Robot, frame::Base>& robot_from_base) {
  if (CandidateCount(detection) == 0) return ",,,,,,";
  const auto pose = robot_from_base * CandidatePose(detection, candidate);
  const Eigen::Vector3d& t = pose.translation();
  const Eigen::Quaterniond& q = pose.rotation();
  return fmt::format("{},{},{},{},{},{},{}", t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
}

}  // namespace

Result<std::string> ScansCsv(const MissionFile& mission) {
  FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission.ListScans());
  std::string csv =
      "scan,uuid,begin_utc,source,simulated,rig_id,from_deg,to_deg,speed_deg_s,state,reason,lines,"
      "images,objects\r\n";
  for (const ScanSummary& scan : scans) {
    FORESIGHT_TRY(const Scan header, mission.LoadHeader(scan.id));
    AddRow(csv, scan.id, scan.uuid, UtcText(scan.begin_utc_ns), scan.source, scan.simulated,
           RigId(header.rig), DegreesFromRadians(scan.plan.from_rad),
           DegreesFromRadians(scan.plan.to_rad), DegreesFromRadians(scan.plan.speed_rad_s),
           ToString(scan.state), scan.reason, scan.lines, scan.images, scan.objects);
  }
  return csv;
}

Result<std::string> DetectionsCsv(const MissionFile& mission) {
  FORESIGHT_TRY(const std::vector<DetectionRecord> records, mission.ListDetections());
  std::map<std::int64_t, Rigid<frame::Robot, frame::Base>> mounts;
  std::string csv =
      "detection,uuid,scan,scan_uuid,kind,name,found_utc,author,decision,decided_utc,decided_by,"
      "deleted,answer,verdict,source,image,program_version,x_m,y_m,z_m,qw,qx,qy,qz\r\n";
  for (const DetectionRecord& record : records) {
    if (record.scan_id != 0 && !mounts.contains(record.scan_id)) {
      FORESIGHT_TRY(const Scan header, mission.LoadHeader(record.scan_id));
      mounts[record.scan_id] = header.rig.robot_from_base;
    }
    const auto detection = DetectionFromJson(record.json);
    // Other programs act on this row: it is about the answer that was decided on.
    const int candidate = detection ? std::clamp(record.decided_candidate, 0,
                                                 std::max(0, CandidateCount(*detection) - 1))
                                    : record.decided_candidate;
    const auto provenance = ProvenanceFromJson(record.provenance_json, record.uuid);
    const auto mount = mounts.find(record.scan_id);
    std::string pose = ",,,,,,";
    if (detection && mount != mounts.end()) pose = PoseCells(*detection, candidate, mount->second);
    csv += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", record.id, Cell(record.uuid),
        record.scan_id, Cell(record.scan_uuid), Cell(record.kind), Cell(record.name),
        UtcText(record.utc_ns), Cell(record.author), ToString(record.decision),
        record.decision == Decision::kOpen ? "" : UtcText(record.decided_utc_ns),
        Cell(record.decided_by), Cell(record.deleted), candidate + 1,
        detection ? ToString(CandidateLevel(*detection, candidate)) : "",
        provenance ? Cell(provenance->source) : "",
        provenance && provenance->image_position >= 0 ? Cell(provenance->image_position) : "",
        provenance ? Cell(provenance->program_version) : "", pose);
  }
  return csv;
}

Result<std::string> NotesCsv(const MissionFile& mission) {
  FORESIGHT_TRY(const std::vector<NoteRecord> notes, mission.ListNotes());
  std::string csv =
      "uuid,scan,scan_uuid,object_uuid,kind,made_utc,made_by,changed_utc,changed_by,text,tags,"
      "deleted,measurement,value,sigma,unit,points_m,plane_from,frame\r\n";
  for (const NoteRecord& note : notes) {
    std::string kind, value, sigma, unit, points, plane, frame;
    if (const auto measured = MeasurementFromJson(note.json); !note.json.empty() && measured) {
      const bool angle = measured->kind == MeasureKind::kAngle;
      const auto number = [angle](double x) {
        return std::isfinite(x) ? fmt::format("{}", angle ? DegreesFromRadians(x) : x) : "";
      };
      kind = ToString(measured->kind);
      value = number(measured->value);
      sigma = number(measured->sigma);
      unit = angle ? "deg" : "m";
      for (const MeasuredPoint& point : measured->points)
        points += fmt::format("{}{} {} {}", points.empty() ? "" : "; ", point.position_m.x(),
                              point.position_m.y(), point.position_m.z());
      if (measured->plane) plane = measured->plane->made_from;
      frame = ToString(measured->frame);
    }
    AddRow(csv, note.uuid, note.scan_id, note.scan_uuid, note.object_uuid, note.kind,
           UtcText(note.made_utc_ns), note.made_by, UtcText(note.utc_ns), note.author, note.text,
           note.tags, note.deleted, kind, value, sigma, unit, points, plane, frame);
  }
  return csv;
}

Result<std::string> EventsCsv(const MissionFile& mission) {
  FORESIGHT_TRY(const std::vector<EventRecord> events, mission.ListEvents());
  std::string csv = "utc,source,severity,text,json\r\n";
  for (const EventRecord& event : events)
    AddRow(csv, UtcText(event.utc_ns), event.source, event.severity, event.text, event.json);
  return csv;
}

}  // namespace foresight
