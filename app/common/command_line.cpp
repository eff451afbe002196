#include "app/common/command_line.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <vector>

#include "app/common/nearest_word.h"

namespace foresight {
namespace {

std::vector<std::string> CommandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

/// What is wrong where a command should be: none, or one that is not known; empty where it is
/// something else.
std::string CommandFault(const CLI::App& app, int argc, char** argv) {
  const CLI::App* level = &app;
  for (int i = 1; i < argc && level->get_require_subcommand_min() > 0; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("-")) continue;
    const std::vector<std::string> commands = CommandsOf(*level);
    if (std::find(commands.begin(), commands.end(), word) != commands.end()) {
      level = level->get_subcommand(word);
      continue;
    }
    const std::string nearest = NearestWord(word, commands);
    if (nearest.empty())
      return fmt::format("'{}' is no command; there are {}", word, Joined(commands));
    return fmt::format("'{}' is no command; did you mean '{}'? There are {}", word, nearest,
                       Joined(commands));
  }
  if (level->get_require_subcommand_min() == 0) return {};
  if (level == &app) return fmt::format("a command is missing: one of {}", Joined(CommandsOf(app)));
  return fmt::format("'{}' needs a command: one of {}", level->get_name(),
                     Joined(CommandsOf(*level)));
}

/// Numbers that CLI11 lets pass: nan and inf, which no option of ours means anything by.
Status CheckFinite(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_type_name().starts_with("FLOAT")) continue;
    for (const std::string& text : option->results())
      if (!std::isfinite(std::strtod(text.c_str(), nullptr)))
        return Fail(ErrorCode::kInvalidOptions, "{}: '{}' is not a finite number",
                    option->get_name(), text);
  }
  for (const CLI::App* command : app.get_subcommands()) FORESIGHT_CHECK(CheckFinite(*command));
  return {};
}

}  // namespace

Result<std::string> ParseCommandLine(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return app.help();
  } catch (const CLI::CallForAllHelp&) {
    return app.help("", CLI::AppFormatMode::All);
  } catch (const CLI::CallForVersion& version) {
    return std::string(version.what()) + "\n";
  } catch (const CLI::RequiredError& error) {
    const std::string fault = CommandFault(app, argc, argv);
    return Fail(ErrorCode::kInvalidOptions, "{} (--help shows how)",
                fault.empty() ? error.what() : fault);
  } catch (const CLI::ParseError& error) {
    return Fail(ErrorCode::kInvalidOptions, "{} (--help shows how)", error.what());
  }
  FORESIGHT_CHECK(CheckFinite(app));
  return std::string();
}

bool AsksForJson(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    if (std::string_view(argv[i]) == "--json") return true;
  return false;
}

std::string FilesNamed(int argc, char** argv) {
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    const std::string name = equals == std::string::npos ? word : word.substr(equals + 1);
    std::error_code error;
    if (std::filesystem::exists(name, error)) files.push_back(name);
  }
  return Joined(files);
}

}  // namespace foresight
