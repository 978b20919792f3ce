#include "apps/shell.h"

#include <array>
#include <cstdio>
#include <memory>

namespace indet::app {

std::string first_line_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  std::array<char, 256> line{};
  if (!pipe || std::fgets(line.data(), line.size(), pipe.get()) == nullptr) return "";
  const std::string text = line.data();
  return text.substr(0, text.find_first_of("\r\n"));
}

std::optional<double> seconds_from(const std::string& text) {
  int days = 0, hours = 0, minutes = 0, seconds = 0;
  char rest = 0;
  const char* const all = text.c_str();
  if (std::sscanf(all, "%d-%d:%d:%d%c", &days, &hours, &minutes, &seconds, &rest) == 4 ||
      (days = 0, std::sscanf(all, "%d:%d:%d%c", &hours, &minutes, &seconds, &rest) == 3) ||
      (hours = 0, std::sscanf(all, "%d:%d%c", &minutes, &seconds, &rest) == 2) ||
      (seconds = 0, std::sscanf(all, "%d%c", &minutes, &rest) == 1))
    return ((days * 24.0 + hours) * 60 + minutes) * 60 + seconds;
  return std::nullopt;
}

}  // namespace indet::app
