#include "ui/viewmodels/import_view_model.h"

#include "core/exchange/import_mission.h"

namespace foresight {
namespace {

/// A name in the folder that nothing has yet.
std::filesystem::path FreeName(const std::filesystem::path& folder,
                               const std::filesystem::path& first) {
  const std::filesystem::path name = first.filename().empty() ? first.parent_path() : first;
  const std::string stem = name.stem().string() + "-imported";
  std::filesystem::path path = folder / (stem + ".foresight");
  std::error_code error;
  for (int number = 2; std::filesystem::exists(path, error); ++number)
    path = folder / fmt::format("{}-{}.foresight", stem, number);
  return path;
}

struct Imported {
  std::filesystem::path mission;
  ImportReport report;
};

}  // namespace

ImportViewModel::ImportViewModel(SessionModel* session, QObject* parent)
    : QObject(parent), session_(session) {}

void ImportViewModel::Import(const QStringList& files, const QString& folder,
                             const ImportOptions& options) {
  if (files.isEmpty()) return;
  std::vector<std::filesystem::path> sources;
  for (const QString& file : files) sources.emplace_back(file.toStdString());
  const auto work = [sources, options, folder = std::filesystem::path(folder.toStdString())](
                        const RunContext& context) -> Result<Imported> {
    Imported imported{FreeName(folder, sources.front()), {}};
    FORESIGHT_TRY(imported.report, ImportMission(sources, imported.mission, options, context));
    return imported;
  };
  const QString doing = tr("Importing");
  runner_.Run<Imported>(doing, work, [this, doing](const Result<Imported>& imported) {
    if (!imported) {
      session_->Report(NoticeOf(doing, imported.error()));
      return;
    }
    const auto& scans = imported->report.scans;
    const QString file = QString::fromStdString(imported->mission.string());
    QString assumed;
    for (const ImportReport::Entry& scan : scans)
      for (const std::string& note : scan.notes)
        if (assumed.isEmpty()) assumed = QString::fromStdString(note);
    session_->Report(
        {assumed.isEmpty() ? Notice::Level::kInfo : Notice::Level::kWarning,
         scans.size() == 1 ? tr("Imported a scan into %1.").arg(file)
                           : tr("Imported %1 scans into %2.")
                                 .arg(static_cast<qulonglong>(scans.size()))
                                 .arg(file),
         assumed.isEmpty()
             ? QString()
             : tr("The mission's log says what was assumed; first: %1.").arg(assumed)});
    Q_EMIT this->imported(file);
  });
}

}  // namespace foresight
