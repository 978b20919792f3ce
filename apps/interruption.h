#pragma once

#include <functional>
#include <string>

namespace indet::app {

/// SIGINT and SIGTERM stop the program, and SIGUSR1 as SIGTERM does: what a batch system may send some time
/// before the end. From then on progress callbacks ask to stop, and no file takes its
/// name any more, so that work which hears of it ends with Interrupted. Work that does not hear soon, as in a
/// library, is ended where it is: what is being written under temporary names is removed first. A second
/// signal ends all work at once.
void catch_signals();

/// The signal that arrived, or 0.
int caught_signal();

/// Whether a file took its name in this run, checkpoints aside.
bool has_written();

/// Notes that one did while a checkpoint was due.
void set_written();

/// Says on standard error that the run was stopped and what it leaves, once; returns the exit status.
int stopped();

/// What `stopped` says is left, instead of whether anything was written.
void set_remains(std::string text);

/// What is done last where the program is ended amid work that does not hear of a signal; from another
/// thread. Empty: nothing.
void set_last_act(std::function<void()> act);

/// While one lives, a run that is told to stop may still write a checkpoint, and gets the time for what it
/// has to finish before that.
class CheckpointTime {
 public:
  CheckpointTime();
  ~CheckpointTime();
  CheckpointTime(const CheckpointTime&) = delete;
  CheckpointTime& operator=(const CheckpointTime&) = delete;
};

}  // namespace indet::app
