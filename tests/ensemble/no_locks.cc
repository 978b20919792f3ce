// Preloaded: a file system that refuses locks, as many network file systems do. FLOCK_ERRNO is the error.
#include <cerrno>
#include <cstdlib>

extern "C" int flock(int /*descriptor*/, int /*operation*/) {
  const char* number = std::getenv("FLOCK_ERRNO");
  errno = number == nullptr ? ENOLCK : std::atoi(number);
  return -1;
}
