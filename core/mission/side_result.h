#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/depth/pipeline.h"
#include "core/mission/mission_file.h"
#include "core/mission/run_again.h"

namespace foresight {

/// A scan worked through again with other settings (RunAgain), kept beside what was recorded. Its
/// depth maps and fits are records like all others; an event of the file with the review holds
/// them together (docs/formats.md, "Side results").
struct SideResult {
  std::string uuid;
  std::string name;  ///< given by who made it
  std::string scan_uuid;
  std::string author;
  std::int64_t utc_ns = 0;
  std::string rig_id;
  bool other_rig = false;  ///< than the scan's own
  DepthOptions depth;
  std::vector<std::string> depth_uuids;
  std::vector<std::string> detection_uuids;
  std::string answer_json;  ///< RunAgainAnswer::json, bit for bit
  bool deleted = false;     ///< was taken out of the lists; its records stay
};

/// Adds a side result to the file of a review: its rig, where it is not the scan's own, its depth
/// maps, its fits, and what holds them together. Whoever opens the scan's mission is not touched.
/// @param scan as it was run again: its uuid counts
/// Fails with kInvalidInput without a name, and as MissionFile does.
Result<SideResult> KeepSideResult(MissionFile& review, const std::string& name, const Scan& scan,
                                  const RunAgainSettings& settings, const RunAgainAnswer& answer);

/// Of one scan, or of all, the oldest first, under their present names, without those that were
/// deleted. `file` is a review, or a mission that one was merged into. Fails with kBadData, naming
/// the event at fault.
Result<std::vector<SideResult>> ListSideResults(const MissionFile& file,
                                                const std::string& scan_uuid = {});
/// The same of a mission and its review, which may be nullptr: what the review says of the
/// mission's own counts.
Result<std::vector<SideResult>> SideResultsOf(const MissionFile& mission, const MissionFile* review,
                                              const std::string& scan_uuid = {});

/// Gives a side result another name. Nothing is overwritten: the change is an event of `review`.
/// Fails with kInvalidInput without a name, and as MissionFile does.
Status RenameSideResult(MissionFile& review, const std::string& uuid, const std::string& name);
/// Takes a side result out of the lists, or brings it back. Its records stay in the file.
Status DeleteSideResult(MissionFile& review, const std::string& uuid);
Status RestoreSideResult(MissionFile& review, const std::string& uuid);

/// Uuids of the detections in a file that belong to side results, deleted ones too: they are no
/// findings of their own.
Result<std::set<std::string>> DetectionsOfSideResults(const MissionFile& file);

/// Whether an event is what holds a side result together, or changes one.
bool IsSideResult(const EventRecord& event);

/// The mission's detections of a scan and those of its review, which may be nullptr, as they stand
/// now: what a review says of an object counts more. Without those of side results.
Result<std::vector<DetectionRecord>> DetectionsOfScan(const MissionFile& mission,
                                                      const MissionFile* review,
                                                      const std::string& scan_uuid);

/// The mission's notes and those of its review, which may be nullptr, as they stand now: what a
/// review says of a note counts more. Deleted ones are among them.
Result<std::vector<NoteRecord>> NotesOfMission(const MissionFile& mission,
                                               const MissionFile* review);

/// What a mission's own depth map of the image was made with; the default method's options where
/// it keeps none. A map of another image of the scan counts where there is none of this one.
Result<DepthOptions> OriginalDepthOptions(const MissionFile& mission, std::int64_t scan_id,
                                          std::int64_t image_position);

/// In what depth options differ, in words that an operator knows: "method paper instead of
/// foresight", "Threshold 0.25 instead of 0.35". Options of another method are compared with what
/// that method is meant to run with. Empty = in nothing.
std::vector<std::string> DifferencesInWords(const DepthOptions& options, const DepthOptions& than);

/// The same of a side result: depth options, rig, source and options of fits.
std::vector<std::string> DifferencesInWords(const SideResult& result, const DepthOptions& original,
                                            const SensorRig& own_rig);

}  // namespace foresight
