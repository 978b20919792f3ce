#pragma once

namespace indet::app {

/// SIGINT and SIGTERM are remembered, so that the work can stop at a safe point; a second one ends the
/// process at once.
void catch_signals();

/// The signal that arrived, or 0.
int caught_signal();

}  // namespace indet::app
