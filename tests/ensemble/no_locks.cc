// Preloaded: a file system that refuses locks, as many network file systems do. FLOCK_ERRNO is the error.
#include <dlfcn.h>
#include <fcntl.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>

namespace {

int refuse() {
  const char* number = std::getenv("FLOCK_ERRNO");
  errno = number == nullptr ? ENOLCK : std::atoi(number);
  return -1;
}

bool is_lock(int command) {
  return command == F_SETLK || command == F_SETLKW || command == F_OFD_SETLK || command == F_OFD_SETLKW;
}

}  // namespace

extern "C" int flock(int /*descriptor*/, int /*operation*/) { return refuse(); }

/// The third argument, where there is one, is an int or a pointer: both are passed as a pointer is.
#define REFUSING(name)                                                                          \
  extern "C" int name(int descriptor, int command, ...) {                                       \
    if (is_lock(command)) return refuse();                                                      \
    std::va_list rest;                                                                          \
    va_start(rest, command);                                                                    \
    void* const argument = va_arg(rest, void*);                                                 \
    va_end(rest);                                                                               \
    static const auto next = reinterpret_cast<int (*)(int, int, ...)>(dlsym(RTLD_NEXT, #name)); \
    return next(descriptor, command, argument);                                                 \
  }
REFUSING(fcntl)
REFUSING(fcntl64)
