#include "program.hpp"

#include "document/json_text.hpp"
#include "document/json_writer.hpp"

#include <gtest/gtest.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hauberk::test {

namespace fs = std::filesystem;
namespace json = boost::json;

WorkFolder::WorkFolder()
{
  std::string name = (fs::temp_directory_path() / "hauberk-experiments-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

WorkFolder::~WorkFolder()
{
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string WorkFolder::write(const std::string& name, const std::string& text) const
{
  std::string file = *this / name;
  std::ofstream(file) << text;
  return file;
}

Process::Process(const std::vector<std::string>& arguments, const WorkFolder& folder, const std::string& out,
                 const std::string& err)
    : out_(out.empty() ? folder / "stdout" : out), err_(err.empty() ? folder / "stderr" : err)
{
  std::vector<char*> words{const_cast<char*>(HAUBERK_PROGRAM)};
  for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int error = posix_spawn(&pid_, HAUBERK_PROGRAM, &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("the program cannot be started");
}

void Process::signal(int number) const { ::kill(pid_, number); }

Outcome Process::wait()
{
  int status = 0;
  ::waitpid(pid_, &status, 0);
  Outcome o;
  o.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  if (fs::is_regular_file(out_)) o.out = read_text(out_);
  if (fs::is_regular_file(err_)) o.err = read_text(err_);
  return o;
}

Outcome run_program(const std::vector<std::string>& arguments)
{
  const WorkFolder folder;
  return Process(arguments, folder).wait();
}

std::string read_text(const fs::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> lines_of(const fs::path& file)
{
  std::vector<std::string> lines;
  std::ifstream in(file, std::ios::binary);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

json::value read_results(const fs::path& folder)
{
  return read_json_file((folder / "results.json").string());
}

json::value read_timings(const fs::path& folder)
{
  return read_json_file((folder / "timings.json").string());
}

double number_at(const json::value& document, const std::string& pointer)
{
  const json::value& v = document.at_pointer(pointer);
  return v.is_null() ? std::numeric_limits<double>::quiet_NaN() : v.to_number<double>();
}

namespace {

json::value without_chart_times(const json::value& document)
{
  constexpr std::array<json::string_view, 4> timed{"seconds", "peak_memory_bytes", "pareto", "machine"};
  if (const json::object* o = document.if_object()) {
    json::object out;
    for (const auto& [key, value] : *o) {
      if (std::find(timed.begin(), timed.end(), key) == timed.end()) out[key] = without_chart_times(value);
    }
    return out;
  }
  if (const json::array* a = document.if_array()) {
    json::array out;
    for (const json::value& v : *a) out.push_back(without_chart_times(v));
    return out;
  }
  return document;
}

}  // namespace

json::value timeless(const json::value& document)
{
  return document.as_object().contains("chart") ? without_chart_times(document) : document;
}

std::string with(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from << " twice";
  return text.replace(at, from.size(), to);
}

std::string chain_text()
{
  return R"({
  "name": "chain",
  "elements": {
    "link": { "shape": "torus_union", "tori": [ { "name": "ring" } ],
      "parameters": { "ring.R": 5.0, "ring.r0": 0.7, "ring.r1": 0.7 } } },
  "cell": {
    "vectors": [[12, 0], [0, 100]],
    "place": [
      { "element": "link", "position": [0, 0, 0] },
      { "element": "link", "position": [6, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 90 } } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "solver": { "preset": "accurate" },
  "expect": [ { "pointer": "/limits/0/value", "value": 0.43333333333333, "rel": 1e-8 } ]
})";
}

std::string union_text()
{
  return R"({
  "name": "union",
  "elements": {
    "link": { "shape": "union", "parts": [
        { "name": "eye", "shape": "torus_union", "rotation": { "axis": [0, 1, 0], "degrees": 90 },
          "tori": [ { "name": "ring", "position": [0, 0, 4], "axis": [1, 0, 0] } ] },
        { "name": "hook", "shape": "closed_tube", "curve": "oval", "position": [-5, 0, 0],
          "rotation": { "axis": [1, 0, 0], "degrees": 90 } } ],
      "parameters": { "eye.ring.R": 4, "eye.ring.r0": 0.6, "eye.ring.r1": 0.6,
                      "hook.half_length": 5, "hook.half_width": 3, "hook.r": 0.6 } } },
  "cell": { "vectors": [[15, 0], [0, 100]],
            "place": [ { "element": "link", "position": [0, 0, 0] } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "solver": { "preset": "accurate" },
  "expect": [ { "pointer": "/limits/0/value", "value": 0.12, "abs": 1e-9 } ]
})";
}

std::string chainmail_text()
{
  return R"({
  "name": "mail",
  "elements": {
    "ring": { "shape": "torus_union", "tori": [ { "name": "ring" } ],
      "parameters": { "ring.R": 4.9, "ring.r0": 1.15, "ring.r1": 1.15 } } },
  "cell": {
    "vectors": [[12.2, 0], [0, 6]], "repeat": [2, 1],
    "place": [
      { "element": "ring", "position": [0, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": -36.5 } },
      { "element": "ring", "position": [6.1, 3, 0], "rotation": { "axis": [1, 0, 0], "degrees": 36.5 } } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0, 30, 90] },
  "solver": { "tolerance": 1e-3, "starts": 2 }
})";
}

std::string design_text()
{
  // Compressions have many starts each, and nothing here is about them.
  const std::string stretched = with(chainmail_text(), R"("directions_deg": [0, 30, 90])",
                                     R"("directions_deg": [0, 30, 90], "senses": ["stretch"])");
  return with(with(stretched, R"("name": "mail",)", R"("name": "mail", "task": "design",)"),
              R"("starts": 2 })",
              R"("starts": 1 },
  "design": { "optimizer": { "plugin": "sqp" }, "quantity": "stretch",
    "variables": [ { "parameters": "ring.R", "per": "all", "lower": 4.5, "upper": 5.4 } ],
    "targets": [ { "direction_deg": 0, "value": 0.066 } ],
    "hole_clearance": 0.3, "rest_clearance": 0.05, "perturbation": 0, "max_iterations": 3 })");
}

std::string map_text()
{
  return with(with(with(chain_text(), R"("name": "chain",)", R"("name": "map", "task": "stability",)"),
                   R"([ { "pointer": "/limits/0/value", "value": 0.43333333333333, "rel": 1e-8 } ])",
                   R"([ { "pointer": "/stability/counts/silent_wrong", "value": 2 } ])"),
              R"("solver": { "preset": "accurate" },)", R"("stability": {
    "methods": [
      { "name": "wide", "set": { "/solver/tolerance": 1e-3, "/solver/contact": "nearest" } },
      { "name": "accurate", "set": { "/solver/preset": "accurate" } } ],
    "families": [
      { "name": "thickness", "why": "until it overlaps",
        "vary": [ { "pointer": ["/elements/link/parameters/ring.r0", "/elements/link/parameters/ring.r1"],
                    "values": [0.7, 0.5, 0.6, 2.9] } ],
        "exact": [0.43333333333333, 0.4, 0.6, null] },
      { "name": "across", "set": { "/load_case/directions_deg": [90] }, "solvable": false,
        "vary": [ { "pointer": "/solver/starts", "values": [1] } ] } ] },)");
}

std::string sweep_text()
{
  return R"({
  "name": "chains", "task": "sweep",
  "elements": {
    "a": { "shape": "torus_union", "tori": [ { "name": "ring" } ],
      "parameters": { "ring.R": 5.0, "ring.r0": 0.7, "ring.r1": 0.7 } },
    "b": { "shape": "torus_union", "tori": [ { "name": "ring" } ],
      "parameters": { "ring.R": 5.0, "ring.r0": 0.7, "ring.r1": 0.7 } } },
  "cell": {
    "vectors": [[12, 0], [0, 100]],
    "place": [
      { "element": "a", "position": [0, 0, 0] },
      { "element": "b", "position": [6, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 90 } } ] },
  "load_case": { "plugin": "in_plane_periodic", "directions_deg": [0], "senses": ["stretch"] },
  "sweep": { "vary": [
    { "name": "R", "pointers": ["/elements/a/parameters/ring.R", { "pointer": "/elements/b/parameters/ring.R", "factor": 0.5, "offset": 2.5 }], "values": [4.8, 5.2, 0.6] },
    { "name": "r", "pointers": ["/elements/a/parameters/ring.r0", "/elements/a/parameters/ring.r1", "/elements/b/parameters/ring.r0", "/elements/b/parameters/ring.r1"], "values": [0.5, 0.6, 0.7] } ] },
  "expect": [ { "pointer": "/sweep/counts/refused", "value": 3 } ]
})";
}

std::string transition_text()
{
  return with(with(with(chain_text(), R"("name": "chain",)", R"("name": "turn", "task": "transition",)"),
                   R"([6, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 90 })",
                   R"([8.58, 0, 0], "rotation": { "axis": [1, 0, 0], "degrees": 43.27 })"),
              R"("solver": { "preset": "accurate" },
  "expect": [ { "pointer": "/limits/0/value", "value": 0.43333333333333, "rel": 1e-8 } ])",
              R"("transition": { "activation_distance": 0.1, "contacts": ["nearest", "arc"],
    "paths": [ { "name": "pitchfork", "steps": 10,
                 "rotation": { "axis": [1, 0, 0], "degrees": [4, -1.5] } } ] },
  "expect": [ { "pointer": "/transition/paths/0/curves/0/energy_jump/relative", "min": 0.2 },
              { "pointer": "/transition/paths/0/curves/1/energy_jump/relative", "max": 1e-7 } ])");
}

std::string chart_text()
{
  return with(
      with(with(chain_text(), R"("name": "chain",)", R"("name": "lines", "task": "chart",)"),
           R"("expect": [ { "pointer": "/limits/0/value", "value": 0.43333333333333, "rel": 1e-8 } ])",
           R"("expect": [ { "pointer": "/chart/counts/failed", "value": 2 } ])"),
      R"("solver": { "preset": "accurate" },)", R"("solver": { "neighbours": 0 },
  "chart": {
    "repeats": 2,
    "scenes": [
      { "name": "chain", "set": {}, "exact": 0.43333333333333335 },
      { "name": "thin, both ways", "set": { "/elements/link/parameters/ring.r0": 0.6, "/elements/link/parameters/ring.r1": 0.6, "/load_case/directions_deg": [0, 90] },
        "reference": { "set": { "/solver/contact": "arc", "/solver/tolerance": 1e-8 } } } ],
    "methods": [
      { "name": "nearest", "set": { "/solver/contact": "nearest" },
        "vary": [ { "pointer": "/solver/tolerance", "values": [1e-2, 1e-6] } ] },
      { "name": "arc", "set": { "/solver/contact": "arc" }, "scenes": ["chain"],
        "vary": [ { "pointer": "/solver/tolerance", "values": [1e-2, 1e-6, 1e-6] }, { "pointer": "/solver/max_iterations", "values": [500, 500, 1] } ],
        "labels": ["coarse", "fine", "hasty"] } ],
    "threads": [1, 2] },)");
}

}  // namespace hauberk::test
