#include "apps/trial_reading.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "apps/ensemble/tables/ensemble_file.h"
#include "libindet/base/error.h"
#include "libindet/io/bias_file.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/ranges_file.h"
#include "libindet/io/sampling_file.h"
#include "libindet/io/simulation_file.h"

namespace indet::app {
namespace {

using Read = std::function<void(const std::filesystem::path&)>;

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

/// Processor time of this process from now on.
void limit_time(rlim_t seconds) {
  rusage used{};
  rlimit limit{};
  getrusage(RUSAGE_SELF, &used);
  getrlimit(RLIMIT_CPU, &limit);
  const auto spent = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  limit.rlim_cur = std::min(spent + seconds, limit.rlim_max);
  setrlimit(RLIMIT_CPU, &limit);
}

/// Writes a byte before each file, so that the parent knows which was the last.
[[noreturn]] void read_in_child(const std::vector<std::filesystem::path>& paths, const Read& read,
                                int marks) {
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDERR_FILENO);
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGINT, SIGTERM})
    std::signal(number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody waits for it any more
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (const std::filesystem::path& path : paths) {
    if (write(marks, "", 1) != 1) _exit(0);
    std::error_code ignored;
    limit_time(seconds_for(std::filesystem::file_size(path, ignored)));
    attempt([&] { read(path); });
  }
  _exit(0);
}

/// Until the other end is closed.
std::size_t count_bytes(int descriptor) {
  std::array<char, 256> bytes;
  std::size_t count = 0;
  while (true) {
    const ssize_t size = read(descriptor, bytes.data(), bytes.size());
    if (size > 0) count += static_cast<std::size_t>(size);
    if (size == 0 || (size < 0 && errno != EINTR)) return count;
  }
}

}  // namespace

void try_reading(const std::vector<std::filesystem::path>& paths, const Read& read) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  std::copy_if(paths.begin(), paths.end(), std::back_inserter(files), [&](const std::filesystem::path& path) {
    return std::filesystem::is_regular_file(path, ignored);
  });
  std::array<int, 2> ends{};
  if (files.empty() || pipe(ends.data()) != 0) return;
  const auto [from_child, to_parent] = ends;
  const pid_t child = fork();
  if (child == 0) read_in_child(files, read, to_parent);
  close(to_parent);
  const std::size_t begun = count_bytes(from_child);
  close(from_child);
  if (child < 0) return;  // no process to be had: read without a trial
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return;
  }
  if ((WIFEXITED(status) && WEXITSTATUS(status) == 0) || begun == 0) return;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGINT || signal == SIGTERM) return;
  const bool is_endless = signal == SIGXCPU || signal == SIGKILL;
  throw InputError(fmt::format("{}: the file is damaged: the HDF5 library {} while reading it",
                               files[begun - 1].string(),
                               is_endless ? "did not come to an end" : "was stopped by an error of its own"));
}

Hdf5File open_on_trial(const std::filesystem::path& path) {
  try_reading({path}, [](const std::filesystem::path& tried) {
    const Hdf5File file = open_indet_file(tried);
    attempt([&] { read_packing(file); });
    attempt([&] { read_ranges(file); });
    attempt([&] { read_sampling(file); });
    attempt([&] { read_sampling(file, "/uniform"); });
    attempt([&] { read_bias(file); });
    attempt([&] { read_trajectory(file); });
    attempt([&] { read_checkpoint(file); });
    attempt([&] { read_ensemble(file); });
    attempt([&] { compute_digests(file); });
  });
  return open_indet_file(path);
}

}  // namespace indet::app
