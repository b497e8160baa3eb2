#include "benchmarks/machine.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace maxwrench {

std::string describe_machine() {
  std::string processor = "unknown";
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.starts_with("model name")) {
      processor = line.substr(line.find(':') + 2);
      break;
    }
  }
  utsname system{};
  uname(&system);
  return fmt::format("maxwrench {}\nprocessor {}\ncores {}\nsystem {} {}\ncompiler {}\n",
                     MAXWRENCH_VERSION, processor, std::thread::hardware_concurrency(),
                     system.sysname, system.machine, __VERSION__);
}

}  // namespace maxwrench
