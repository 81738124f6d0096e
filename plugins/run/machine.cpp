#include "run/machine.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

namespace hauberk {
namespace {

/// The first entry "model name : ..."; some processors have none.
std::string processor_name()
{
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(':');
    const std::size_t name = line.find_first_not_of(" \t", std::min(colon, line.size() - 1) + 1);
    return name < line.size() ? line.substr(name) : "";
  }
  return "";
}

}  // namespace

Machine this_machine()
{
  Machine machine;
  machine.processor = processor_name();
  machine.processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  double load = 0.0;
  if (::getloadavg(&load, 1) == 1) machine.load_average = load;
  return machine;
}

}  // namespace hauberk
