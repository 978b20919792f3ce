#pragma once

#include <stdexcept>
#include <string>

namespace indet {

/// The input cannot be used as it is: a file, a value or an option. The message names the file, the place
/// in it and the reason, and says what to do. The program ends with exit status 3 and writes nothing.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A library that we call failed in a way that no input explains (out of memory, a full disk, an
/// assertion inside GLPK). The program ends with exit status 1.
class LibraryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A path where no file can be made: read-only, no such folder, no right to.
class UnwritablePath : public InputError {
 public:
  using InputError::InputError;
};

/// A file that was begun cannot be written to its end: the disk is full, or fails.
class WritingFailed : public LibraryError {
 public:
  using LibraryError::LibraryError;
};

/// The user, or a caller's progress callback, asked to stop. Nothing half-written is left behind.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace indet
