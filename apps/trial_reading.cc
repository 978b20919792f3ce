#include "trial_reading.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <system_error>

#include "indet/base/error.h"
#include "indet/io/packing_file.h"
#include "indet/io/ranges_file.h"
#include "indet/io/sampling_file.h"
#include "indet/io/simulation_file.h"

namespace indet::app {
namespace {

/// Processor time for reading a file, far above what it takes.
rlim_t seconds_for(std::uintmax_t bytes) {
  constexpr std::uintmax_t kBytesPerSecond = 10'000'000;
  return 5 + bytes / kBytesPerSecond;
}

template <class Read>
void attempt(Read read) {
  try {
    read();
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): the caller will meet it again
  }
}

[[noreturn]] void read_in_child(const std::filesystem::path& path) {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDERR_FILENO);
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) std::signal(number, SIG_DFL);
  const rlimit no_core{0, 0};
  std::error_code ignored;
  const rlim_t seconds = seconds_for(std::filesystem::file_size(path, ignored));
  const rlimit time{seconds, seconds};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &time);
  attempt([&] { read_packing(path); });
  attempt([&] { read_ranges(path); });
  attempt([&] { read_sampling(path); });
  attempt([&] { read_trajectory(path); });
  attempt([&] { read_checkpoint(path); });
  attempt([&] { compute_digests(path); });
  _exit(0);
}

}  // namespace

void try_reading(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;
  const pid_t child = fork();
  if (child == 0) read_in_child(path);
  if (child < 0) return;  // no process to be had: read without a trial
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return;
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGINT || signal == SIGTERM) return;
  const bool is_endless = signal == SIGXCPU || signal == SIGKILL;
  throw InputError(fmt::format("{}: the file is damaged: the HDF5 library {} while reading it", path,
                               is_endless ? "did not come to an end" : "was stopped by an error of its own"));
}

}  // namespace indet::app
