#include "benchmarks/suite/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include "maxwrench/version.h"

namespace maxwrench {

std::string processor_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string build_line() {
  std::istringstream lines(describe_build());
  std::string text, line;
  std::getline(lines, line);  // the version and
  std::getline(lines, line);  // the sources, which have columns of their own
  while (std::getline(lines, line)) text += (text.empty() ? "" : "; ") + line;
  return text;
}

std::string describe_machine() {
  utsname system{};
  uname(&system);
  return describe_build() + fmt::format("processor {}\ncores {}\nsystem {} {}\ndate {:%F} UTC\n",
                                        processor_name(), std::thread::hardware_concurrency(),
                                        system.sysname, system.machine,
                                        fmt::gmtime(std::time(nullptr)));
}

}  // namespace maxwrench
