#include "app/ctl/late/late_command.h"

#include <dlfcn.h>

#include <stdexcept>

namespace foresight {
namespace {

constexpr const char* kLibrary = "libforesightctl_late.so";

AddLateOptions* FromLibrary(const char* name) {
  // Stays loaded until the program ends: the options and what they do are in it.
  static void* const library = ::dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
  void* const function = library == nullptr ? nullptr : ::dlsym(library, name);
  if (function == nullptr)
    throw std::runtime_error(
        fmt::format("{}; install it beside libforesight_core.so", ::dlerror()));
  return reinterpret_cast<AddLateOptions*>(function);
}

/// The options are there before the command's own arguments, --help among them, are parsed.
void AddLateCommand(CLI::App& app, const char* name, const char* help, const char* options,
                    Invocation& invocation) {
  CLI::App* command = app.add_subcommand(name, help);
  command->preparse_callback([command, options, &invocation](std::size_t) {
    const bool has_help_alone = command->get_options().size() <= 1;  // else it was called before
    if (has_help_alone) FromLibrary(options)(command, &invocation);
  });
}

}  // namespace

void AddMapCommand(CLI::App& app, Invocation& invocation) {
  AddLateCommand(app, "map",
                 "Bring the scans of a mission together, and find what changed between two",
                 "AddMapOptions", invocation);
}

void AddMissionImportCommand(CLI::App& mission, Invocation& invocation) {
  AddLateCommand(mission, "import", "Make a mission of other programs' clouds, images and bags",
                 "AddMissionImportOptions", invocation);
}

void AddMissionExportCommand(CLI::App& mission, Invocation& invocation) {
  AddLateCommand(mission, "export",
                 "Write a mission for other programs: clouds, surfaces, depth maps, tables, a bag",
                 "AddMissionExportOptions", invocation);
}

void AddBundleCommand(CLI::App& app, Invocation& invocation) {
  AddLateCommand(app, "bundle",
                 "Pack what somebody needs to find out what went wrong; nothing secret gets in",
                 "AddBundleOptions", invocation);
}

}  // namespace foresight
