// Nasty inputs for every reader of every program, each in a process of its own with little memory
// and little time: no signal, no word of an exception, an exit code from 0 to 3, and a message that
// names the file.
//   nasty_inputs CTL HEAD [--first 0] [--count 2000] [--seed 1] [--only READER] [--keep FOLDER]
// The same seed gives the same inputs. What fails is kept, to be looked at.
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/printable.h"
#include "tests/nasty/mutation.h"
#include "tests/nasty/readers.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace foresight::nasty {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string ctl, head;
  int first = 0;
  int count = 2000;
  std::uint64_t seed = 1;
  int jobs = 2;
  std::string only;
  std::string keep = "nasty-found";
};

constexpr std::size_t kMemory_bytes = std::size_t{4} << 30;
constexpr std::size_t kMostWork_s = 20;
constexpr unsigned kLongest_s = 180;  // of waiting, also where many programs run

/// What stands at a path in place of a file.
constexpr const char* kPlaces[] = {"a folder",          "a pipe",     "nothing",
                                   "a circle of links", "a device",   "an endless device",
                                   "a long name",       "an odd name"};
constexpr int kPlaceCount = 8;

/// Puts it there. @returns the path that the program is given.
std::string MakePlace(int place, const fs::path& folder, const std::string& name) {
  const fs::path path = folder / name;
  switch (place) {
    case 0:
      fs::create_directory(path);
      return path;
    case 1:
      if (mkfifo(path.c_str(), 0600) != 0) throw std::runtime_error("no pipe");
      return path;
    case 2:
      return path;
    case 3:
      fs::create_symlink(name, path);
      return path;
    case 4:
      fs::create_symlink("/dev/null", path);
      return path;
    case 5:
      fs::create_symlink("/dev/zero", path);
      return path;
    case 6:
      return (folder / std::string(5000, 'n')).string() + name;
    default:
      return (folder / "\x1b[31m\xff\n").string() + name;
  }
}

struct Input {
  std::string what;  ///< for people
  std::string path;  ///< that the program is given
  bool is_file = true;
};

/// The input of a reader with this number: places, then what is made by hand, then mutations.
Input MakeInput(const Reader& reader, int number, Random& random, const fs::path& folder) {
  if (number < kPlaceCount)
    return {kPlaces[number], MakePlace(number, folder, reader.file_name), false};
  number -= kPlaceCount;
  const bool by_hand = number < static_cast<int>(reader.handmade.size());
  const std::string bytes = by_hand ? reader.handmade[static_cast<std::size_t>(number)]
                            : reader.text || random.Index(4) == 0
                                ? MutatedText(reader.good, random)
                                : MutatedBytes(reader.good, random);
  const fs::path path = folder / reader.file_name;
  if (!WriteFileAtomically(path, bytes)) throw std::runtime_error("cannot write the input");
  return {fmt::format("{} {}", by_hand ? "by hand" : "mutation", number), path, true};
}

std::string LastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return {};
  const std::size_t begin = text.rfind('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

bool IsJson(const std::string& text) {
  return nlohmann::json::accept(text);
}

/// What is wrong with how the program took it; empty where nothing is.
std::string Fault(const Reader& reader, const std::vector<std::string>& arguments,
                  const ProgramResult& result) {
  if (result.exit_code > 128) return fmt::format("signal {}", result.exit_code - 128);
  if (result.exit_code > 3) return fmt::format("exit code {}", result.exit_code);
  const std::string said = result.errors + result.output;
  for (const char* word :
       {"bad_alloc", "internal error", "terminate called", "length_error", "std::", "Sanitizer"})
    if (said.find(word) != std::string::npos) return fmt::format("says '{}'", word);
  if (PrintableLines(said) != said) return "control bytes, or bytes that are no UTF-8";
  if (result.exit_code >= 2) {
    if (LastLine(result.errors).find(reader.file_name) == std::string::npos &&
        LastLine(result.errors).find("/scene") == std::string::npos &&
        LastLine(result.errors).find("/session") == std::string::npos &&
        LastLine(result.errors).find("/out: is not a file") == std::string::npos)  // it was read
      return "does not name the file";
    const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    if (json && !IsJson(result.output)) return "the error is not JSON";
  }
  return {};
}

/// Tries the inputs of one job. @returns how many went wrong.
int Try(const std::vector<Reader>& readers, const Options& options, int job) {
  RunLimits limits;
  limits.memory_bytes = kMemory_bytes;
  limits.cpu_seconds = kMostWork_s;
  limits.seconds = kLongest_s;
  int wrong = 0;
  for (int i = options.first + job; i < options.first + options.count; i += options.jobs) {
    const Reader& reader = readers[static_cast<std::size_t>(i) % readers.size()];
    Random random(options.seed, static_cast<std::uint64_t>(i));
    const TemporaryFolder folder;
    const fs::path out = folder / "out";
    fs::create_directory(out);
    const Input input =
        MakeInput(reader, i / static_cast<int>(readers.size()), random, folder.path());
    const std::vector<std::string> arguments = reader.command(input.path, out.string());
    const auto start = std::chrono::steady_clock::now();
    const ProgramResult result =
        RunProgram(reader.head ? options.head : options.ctl, arguments, limits);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string fault = Fault(reader, arguments, result);
    if (fault.empty()) continue;
    ++wrong;
    std::string kept;
    if (input.is_file) {
      fs::create_directories(options.keep);
      kept = fmt::format("{}/{}-{}", options.keep, i, reader.file_name);
      fs::copy_file(input.path, kept, fs::copy_options::overwrite_existing);
    }
    std::cout << fmt::format("{}: {}, {}: {} ({:.1f} s) {}\n    {}\n", i, reader.name, input.what,
                             fault, seconds, kept,
                             Printable(LastLine(result.errors)).substr(0, 300))
              << std::flush;
  }
  return wrong;
}

/// Nothing may leave the child but its exit code: the parent's folders are not its own.
int TryAsChild(const std::vector<Reader>& readers, const Options& options, int job) {
  try {
    return std::min(100, Try(readers, options, job));
  } catch (const std::exception& fault) {
    std::cout << "job " << job << ": " << fault.what() << std::endl;
    return 101;
  }
}

/// The jobs are processes: each starts programs, which a program with threads had better not do.
int TryAll(const std::vector<Reader>& readers, const Options& options) {
  std::vector<pid_t> children;
  for (int job = 0; job < options.jobs; ++job) {
    const pid_t child = fork();
    if (child == 0) _exit(TryAsChild(readers, options, job));
    children.push_back(child);
  }
  int wrong = 0;
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    wrong += WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  }
  return wrong;
}

int Main(int argc, char** argv) {
  Options options;
  CLI::App app{"Nasty inputs for every reader"};
  app.add_option("ctl", options.ctl, "foresightctl")->required();
  app.add_option("head", options.head, "foresight-head")->required();
  app.add_option("--first", options.first, "Number of the first input")->capture_default_str();
  app.add_option("--count", options.count, "Inputs")->capture_default_str();
  app.add_option("--seed", options.seed, "Of all mutations")->capture_default_str();
  app.add_option("--jobs", options.jobs, "Programs at a time")->capture_default_str();
  app.add_option("--only", options.only, "Name of one reader");
  app.add_option("--keep", options.keep, "Folder for what fails")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const TemporaryFolder good;
  Result<std::vector<Reader>> readers = AllReaders(good.path().string(), options.ctl);
  if (!readers) {
    std::cerr << readers.error().message << "\n";
    return 1;
  }
  if (!options.only.empty())
    std::erase_if(*readers, [&](const Reader& reader) { return reader.name != options.only; });
  if (readers->empty()) {
    std::cerr << "no reader is named '" << options.only << "'\n";
    return 1;
  }
  const int wrong = TryAll(*readers, options);
  std::cout << fmt::format("{} inputs for {} readers, seed {}: {} went wrong\n", options.count,
                           readers->size(), options.seed, wrong);
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace foresight::nasty

int main(int argc, char** argv) {
  try {
    return foresight::nasty::Main(argc, argv);
  } catch (const std::exception& fault) {
    std::cerr << fault.what() << "\n";
    return 1;
  }
}
