#include "benchmarks/machine.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
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

std::string describe_machine() {
  utsname system{};
  uname(&system);
  return describe_build() + fmt::format("processor {}\ncores {}\nsystem {} {}\n", processor_name(),
                                        std::thread::hardware_concurrency(), system.sysname,
                                        system.machine);
}

}  // namespace maxwrench
