#include <memory>
#include <optional>

#include "app/ctl/choose_object.h"
#include "app/ctl/command.h"
#include "core/base/utc_text.h"
#include "core/mission/mission_file.h"
#include "core/mission/new_records.h"

namespace foresight {
namespace {

struct NoteArguments {
  std::string file;
  std::string text;
  std::string tags;
  std::optional<std::int64_t> scan;
  std::string object;
  std::string change;
  std::string remove;
  bool json = false;
};

/// The note with this uuid or this beginning of it.
Result<NoteRecord> NoteNamed(const MissionFile& file, const std::string& uuid) {
  FORESIGHT_TRY(const std::vector<NoteRecord> notes, file.ListNotes());
  std::optional<NoteRecord> found;
  for (const NoteRecord& note : notes) {
    if (!note.uuid.starts_with(uuid)) continue;
    if (found)
      return Fail(ErrorCode::kInvalidInput, "{}: more than one note begins with '{}'",
                  file.path().string(), uuid);
    found = note;
  }
  if (!found)
    return Fail(ErrorCode::kInvalidInput, "{}: there is no note '{}'", file.path().string(), uuid);
  return *found;
}

Result<NoteRecord> NewNote(const MissionFile& file, const NoteArguments& arguments) {
  NoteRecord note;
  note.uuid = NewUuid();
  note.kind = kNoteKind;
  note.scan_id = arguments.scan.value_or(0);
  if (arguments.object.empty()) return note;
  FORESIGHT_TRY(const DetectionRecord object, ChooseObject(file, arguments.object));
  note.object_uuid = object.uuid;
  note.scan_uuid = object.scan_uuid;
  return note;
}

Result<ExitCode> Note(const NoteArguments& arguments) {
  const bool removes = !arguments.remove.empty(), changes = !arguments.change.empty();
  if (!removes && arguments.text.empty() && arguments.tags.empty())
    return Fail(ErrorCode::kInvalidOptions, "give a text, --tags, or --delete UUID");
  FORESIGHT_TRY(const auto file, MissionFile::Open(arguments.file));
  NoteRecord note;
  if (removes || changes) {
    FORESIGHT_TRY(note, NoteNamed(*file, removes ? arguments.remove : arguments.change));
    note.deleted = removes;
  } else {
    FORESIGHT_TRY(note, NewNote(*file, arguments));
  }
  if (!arguments.text.empty()) note.text = arguments.text;
  if (!arguments.tags.empty()) note.tags = arguments.tags;
  FORESIGHT_TRY(note.tags, TagsFrom(note.tags));
  note.utc_ns = NowUtc_ns();
  note.author = OperatorName();
  FORESIGHT_CHECK(file->AddNote(note));
  FORESIGHT_CHECK(file->Close());
  if (arguments.json)
    PrintJson({{"mission", arguments.file},
               {"uuid", note.uuid},
               {"text", note.text},
               {"tags", note.tags},
               {"author", note.author},
               {"deleted", note.deleted}});
  else
    PrintLine(fmt::format("{} {}", removes ? "deleted" : "kept", note.uuid));
  return ExitCode::kDone;
}

}  // namespace

void AddMissionNoteCommand(CLI::App& mission, Invocation& invocation) {
  const auto arguments = std::make_shared<NoteArguments>();
  CLI::App* command = mission.add_subcommand(
      "note", "Add a note to a mission, a scan or an object; change or delete one");
  command->add_option("file", arguments->file, "Mission file, or its review")->required();
  command->add_option("text", arguments->text, "What to write down");
  command->add_option("--tags", arguments->tags, "Short words, with spaces or commas between them");
  auto* scan =
      command->add_option("--scan", arguments->scan, "The scan it is about, by its number");
  auto* object = command->add_option("--object", arguments->object,
                                     "The object it is about, by its number or uuid");
  scan->excludes(object);
  auto* change = command->add_option("--change", arguments->change,
                                     "Uuid of a note or measurement that gets this text or tags");
  auto* remove = command->add_option("--delete", arguments->remove,
                                     "Uuid of a note or measurement to delete; its row stays");
  change->excludes(remove)->excludes(scan)->excludes(object);
  remove->excludes(scan)->excludes(object);
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->callback([&invocation, arguments] {
    invocation = [arguments](const RunContext&) { return Note(*arguments); };
  });
}

}  // namespace foresight
