/// Logs of searches and of evaluations: lines of any bytes, each with the checksum that belongs to it, so
/// that what is behind the checksum is tried. What is read is written again as it was read.

#include "document/record_line.hpp"
#include "harness.hpp"
#include "parts/locked_record.hpp"
#include "tasks/design/evaluation_log.hpp"

#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using namespace hauberk;

constexpr const char* identity = "fuzz";

[[noreturn]] void violated(const char* property, const std::string& text)
{
  std::fprintf(stderr, "logs: %s\n%s\n", property, text.c_str());
  std::abort();
}

std::string written(const Locked& locked)
{
  RecordWriter out('S');
  write_locked(locked, out);
  return out.text();
}

void try_locked(const std::string& line)
{
  RecordReader in(line);
  const Locked locked = read_locked(in);
  if (!in.good) return;
  const std::string text = written(locked);
  RecordReader again(std::string_view(text).substr(1));
  if (written(read_locked(again)) != text || !again.good)
    violated("a search is not read as it was written", text);
}

void try_evaluations(const std::string& text)
{
  const fs::path file = fs::temp_directory_path() / ("fuzz_logs_" + std::to_string(::getpid()));
  std::istringstream lines(text);
  std::ofstream out(file, std::ios::binary);
  out << "hauberk-evaluations/4 " << identity << '\n';
  std::vector<double> x;
  for (std::string line; std::getline(lines, line);) {
    if (x.empty() && !line.empty()) {
      RecordReader in(std::string_view(line).substr(1));
      x = in.numbers();
    }
    out << record_line(line) << '\n';
  }
  out.close();
  {
    EvaluationLog log(file, identity, true, [](const std::string&) {});
    for (int k = 0; k < 16; ++k) {
      DesignPoint p;
      p.x = x;
      p.rest.macro = Vector::Zero(3);
      p.rest.e = Vector::Zero(6);
      p.rest.rotation.resize(2, Mat3::Identity());
      long evaluations = 0;
      if (!log.recall(p, evaluations)) {
        log.record(p, 1);
        break;
      }
      if (!log.recall_states(p)) log.record_states(p);
    }
  }
  fs::remove(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    static_cast<void>(undamaged_record(line));
    try_locked(line);
  }
  try_evaluations(text);
  return 0;
}
