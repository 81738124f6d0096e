#include "dispatch.hpp"
#include "document/atomic_file.hpp"
#include "document/json_text.hpp"
#include "document/json_writer.hpp"
#include "equilibrium/rest.hpp"
#include "experiment_options.hpp"
#include "limits/room.hpp"
#include "run/interrupt.hpp"
#include "say.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>

namespace hauberk::command {
namespace {

constexpr int most_starts = 100000;

/// The scene in the state that was found: the strain goes into the cell.
SceneSpec scene_in(const Prepared& prepared, const Model& m, const State& state)
{
  SceneSpec scene = with_rest(prepared.scene, m, state);
  if (scene.lattice.empty()) return scene;
  PositionMap at, moved;
  const std::vector<double> none(m.coordinate_count, 0.0);
  const std::span<const double> macro{state.macro.data(), static_cast<std::size_t>(m.macro_count)};
  m.load->position(macro, none, Vec3::Zero(), Vec3::Zero(), at);
  for (std::size_t k = 0; k < scene.lattice.size(); ++k) {
    m.load->position(macro, none, Vec3::Zero(), m.lattice[k], moved);
    scene.lattice[k] = (moved.x - at.x) * m.length;
  }
  return scene;
}

/// Radii of rings and tubes, each kind once.
std::set<std::pair<double, double>> round_rings(const Model& m)
{
  std::set<std::pair<double, double>> rings;
  for (const Body& body : m.bodies) {
    if (body.is_circle_tube()) rings.emplace(body.R, body.r0);
  }
  return rings;
}

/// Ratios of the round rings whose tubes are `grow` thicker than now, each kind once.
std::string ratios(const Model& m, double grow)
{
  std::string text;
  for (const auto& [R, r] : round_rings(m)) {
    const double thick = r + grow;
    text += fmt::format(
        "  ring of radius {:.6g}, wire {:.6g} -> {:.8g}: inner diameter / wire {:.6f} -> {:.6f}\n",
        R * m.length, 2.0 * r * m.length, 2.0 * thick * m.length, (R - r) / r, (R - thick) / thick);
  }
  return text;
}

/// {name, length_unit, room, seed, rings: [{radius, wire, thickest_wire, ratio, smallest_ratio}], starts,
/// near, worst, interrupted}; lengths in the unit of the file.
boost::json::object as_json(const Prepared& prepared, const Room& room, const std::vector<double>& gaps,
                            long near)
{
  const Model& m = prepared.model;
  boost::json::array rings;
  for (const auto& [R, r] : round_rings(m)) {
    const double thick = r + 0.5 * room.best.gap;
    rings.push_back({{"radius", R * m.length},
                     {"wire", 2.0 * r * m.length},
                     {"thickest_wire", 2.0 * thick * m.length},
                     {"ratio", (R - r) / r},
                     {"smallest_ratio", (R - thick) / thick}});
  }
  return {{"name", prepared.experiment.name},
          {"length_unit", prepared.experiment.length_unit},
          {"room", room.best.gap * m.length},
          {"seed", room.best.seed},
          {"rings", std::move(rings)},
          {"starts", room.gaps.size()},
          {"near", near},
          {"worst", gaps.empty() ? 0.0 : gaps.back() * m.length},
          {"interrupted", interrupted()}};
}

}  // namespace

Description room_description()
{
  return {.name = "room",
          .form = "EXPERIMENT.json [--starts N] [-o FILE]",
          .line = "the thickest rings that leave a rest state",
          .synopsis = "room EXPERIMENT.json [options]",
          .summary =
              "Finds the rest state in which the linked elements are farthest apart, and the thickest rings "
              "of which the fabric can be built: inner diameter over wire diameter. A local search from the "
              "rest state and from perturbed ones; the strain is searched with the poses (a patch stays "
              "unbent).",
          .arguments = {experiment_argument()},
          .options = joined({{.name = "starts",
                              .takes = Takes::integer,
                              .value = "N",
                              .help = "starts, the rest state first; default 8"},
                             {.name = "fixed-cell", .help = "keep the cell: poses only"},
                             {.name = "output",
                              .letter = 'o',
                              .takes = Takes::text,
                              .value = "FILE",
                              .help = "write the rest state found as an experiment, to a file that must not "
                                      "exist",
                              .more = "Without it the numbers are only printed.",
                              .offer = Offer::files},
                             json_option()},
                            experiment_options())};
}

int room_command(const std::vector<std::string>& words)
{
  catch_interrupts();
  Options options(room_description());
  options.parse(words);
  RoomSettings settings;
  settings.starts = options.has("starts") ? options.get<int>("starts") : 8;
  if (settings.starts < 1 || settings.starts > most_starts)
    throw UsageError(
        fmt::format("--starts: expected a number from 1 to {}, found {}", most_starts, settings.starts),
        options.usage());
  if (options.has("output")) refuse_existing_file(options.get<std::string>("output"));
  const Job job = open_job(options);
  const Prepared& prepared = *job.prepared;
  // What is free of a patch is how it is bent, and at rest it is not.
  if (options.has("fixed-cell") || prepared.scene.lattice.empty()) settings.cell = Cell::fixed;
  settings.seed = prepared.experiment.seed;
  const Model& m = prepared.model;
  const Room room = find_room(m, settings, 0, [] { return !interrupted(); });
  std::vector<double> gaps = room.gaps;
  std::erase_if(gaps, [](double gap) { return !std::isfinite(gap); });  // starts that lost links
  std::sort(gaps.begin(), gaps.end(), std::greater<>());
  const auto near =
      std::count_if(gaps.begin(), gaps.end(), [&](double g) { return room.best.gap - g < 1e-4; });
  if (options.has("json")) {
    say_json(write_json(as_json(prepared, room, gaps, near)));
  } else {
    say("{}\nlargest rest clearance {:.8g} {} more than solver.clearance (seed {})\n",
        prepared.experiment.name, room.best.gap * m.length, prepared.experiment.length_unit, room.best.seed);
    say("{}", ratios(m, 0.5 * room.best.gap));
    say("{} of {} starts within 1e-4 L of it; the worst {:.8g}\n", near, room.gaps.size(),
        gaps.empty() ? 0.0 : gaps.back() * m.length);
    if (interrupted()) say("{}", "interrupted: the search is not done, there may be more room\n");
  }
  if (options.has("output")) {
    const auto& file = options.get<std::string>("output");
    const Node experiment = scene_experiment(prepared.experiment, scene_in(prepared, m, room.best.state),
                                             prepared.experiment.name + "_room");
    const std::string folder = std::filesystem::path(file).parent_path().string();
    write_new_file_atomically(file, write_json(in_folder(experiment, prepared.experiment, folder)) + "\n");
    if (!options.has("json")) say("written to {}\n", file);
  }
  return interrupted() ? exit_interrupted : exit_done;
}

}  // namespace hauberk::command
