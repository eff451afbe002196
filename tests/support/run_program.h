#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace foresight {

struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal when it was killed by one
  std::string output;  ///< standard output
  std::string errors;  ///< standard error

  int ErrorLines() const {
    int lines = 0;
    for (const char c : errors) lines += c == '\n' ? 1 : 0;
    return lines;
  }
};

/// What a program is given beside its arguments.
struct RunLimits {
  std::size_t memory_bytes = 0;  ///< address space; 0 = as much as there is
  std::size_t file_bytes = 0;    ///< the largest file it may write; 0 = any
  unsigned seconds = 0;          ///< ended by SIGALRM after so long; 0 = never
  std::size_t cpu_seconds = 0;   ///< ended by SIGXCPU after so much work; 0 = never
  std::string output = "";       ///< where standard output leads; empty = into the result
  bool no_output = false;        ///< standard output is closed, as by >&-
  bool no_reader = false;        ///< standard output is a pipe whose reader is gone
};

/// In the child, before the program begins.
inline void ApplyLimits(const RunLimits& limits) {
  const auto limit = [](auto resource, std::size_t most) {
    if (most == 0) return;
    const rlimit both{most, most};
    if (setrlimit(resource, &both) != 0) _exit(124);
  };
  limit(RLIMIT_AS, limits.memory_bytes);
  limit(RLIMIT_FSIZE, limits.file_bytes);
  limit(RLIMIT_CPU, limits.cpu_seconds);
  limit(RLIMIT_CORE, 1);
  if (limits.seconds > 0) alarm(limits.seconds);
  if (limits.no_output) close(STDOUT_FILENO);
  if (limits.no_reader) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0 || dup2(ends[1], STDOUT_FILENO) < 0) _exit(124);
    close(ends[0]);
    close(ends[1]);
  }
}

/// Runs a program to its end. Arguments are passed as they are, without a shell.
inline ProgramResult RunProgram(const std::string& program,
                                const std::vector<std::string>& arguments,
                                const RunLimits& limits = {}) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const std::string err = folder / "err";
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    const std::string& output = limits.output.empty() ? out : limits.output;
    if (std::freopen(output.c_str(), "w", stdout) == nullptr ||
        std::freopen(err.c_str(), "w", stderr) == nullptr)
      _exit(125);
    ApplyLimits(limits);
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    execv(program.c_str(), argv.data());
    _exit(126);
  }
  int status = 0;
  waitpid(child, &status, 0);
  const auto read = [](const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(out), read(err)};
}

}  // namespace foresight
