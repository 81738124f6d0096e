#include "maker/weave_sheet.hpp"

#include "document/json_text.hpp"
#include "document/jsonc.hpp"
#include "document/node_access.hpp"
#include "maker/job_limits.hpp"
#include "maker/lattice_step.hpp"
#include "maker/weave_roll.hpp"
#include "tasks/job.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <boost/json/array.hpp>

#include <cmath>
#include <numbers>

namespace hauberk::maker {
namespace {

constexpr double square_decimetre = 1e4, metre = 1e3;  // mm^2, mm

double length_of(const Node& root, const char* outer, const char* name)
{
  const Node* section = root.find(outer);
  const Node* value = section == nullptr ? nullptr : section->find(name);
  return value != nullptr && value->is(Node::Type::number) ? value->number : 0.0;
}

/// How far a lattice repeats itself along a direction; 0 where it does not.
double pitch_along(const std::vector<Vec3>& lattice, double degrees)
{
  const std::optional<LatticeStep> step = step_along(lattice, degrees);
  return step ? step->length : 0.0;
}

Job job_of(const Weave& weave, const Question& question, double clearance, const WeaveLookup& lookup,
           const std::shared_ptr<const Registry>& registry)
{
  return prepare_job(
      registry, {"hauberk weave " + question.weave, experiment_text(weave, question, clearance), {}, lookup});
}

/// Limits of all ways, both senses.
std::vector<WayAnswer> answers(const Job& job, const Weave& weave, unsigned threads, Progress& progress,
                               const std::string& label)
{
  const Prepared& prepared = *job.prepared;
  const std::vector<LimitTask> tasks = job.task->limit_tasks();
  const std::vector<LimitResult> limits = limits_of(job, threads, label, progress);
  std::vector<WayAnswer> out;
  for (const Weave::Way& way : weave.ways)
    out.push_back({way.name, way.degrees, pitch_along(prepared.scene.lattice, way.degrees), {}, {}, "", ""});
  for (std::size_t k = 0; k < limits.size(); ++k) {
    WayAnswer& way = out[k / 2];
    const bool stretches = tasks[k].sense == Sense::positive;
    const bool locked = limits[k].status == LimitStatus::locked;
    (stretches ? way.stretch : way.compress) = locked ? limits[k].value : std::nullopt;
    (stretches ? way.stretch_status : way.compress_status) = to_string(limits[k].status);
  }
  return out;
}

std::string percent(const std::optional<double>& value, const std::string& status)
{
  return value ? fmt::format("{:+.1f} %", 100.0 * *value) : status;
}

/// Lines of a table of ways.
std::string ways_text(const std::vector<WayAnswer>& ways)
{
  std::string text = fmt::format("  {:<24}{:>12}{:>22}{:>22}{:>18}\n", "", "at rest", "taut",
                                 "pushed together", "packed to taut");
  for (const WayAnswer& way : ways) {
    const auto pitch = [&](const std::optional<double>& strain, const std::string& status) {
      return strain && way.pitch > 0.0
                 ? fmt::format("{:.3f} mm ({})", way.pitch * (1.0 + *strain), percent(strain, status))
                 : percent(strain, status);
    };
    const std::string whole =
        way.stretch && way.compress
            ? fmt::format("{:+.1f} %", 100.0 * ((1.0 + *way.stretch) / (1.0 + *way.compress) - 1.0))
            : "";
    text +=
        fmt::format("  {:<24}{:>12}{:>22}{:>22}{:>18}\n", way.name,
                    way.pitch > 0.0 ? fmt::format("{:.3f} mm", way.pitch) : "",
                    pitch(way.stretch, way.stretch_status), pitch(way.compress, way.compress_status), whole);
  }
  return text;
}

boost::json::array ways_json(const std::vector<WayAnswer>& ways)
{
  boost::json::array out;
  for (const WayAnswer& way : ways) {
    boost::json::object entry{{"name", way.name}, {"direction_deg", way.degrees}};
    entry["pitch_mm"] = way.pitch > 0.0 ? boost::json::value(way.pitch) : nullptr;
    entry["stretch"] = way.stretch ? boost::json::value(*way.stretch) : nullptr;
    entry["stretch_status"] = way.stretch_status;
    entry["compress"] = way.compress ? boost::json::value(*way.compress) : nullptr;
    entry["compress_status"] = way.compress_status;
    out.push_back(std::move(entry));
  }
  return out;
}

}  // namespace

Weave read_weave(const std::string& name, const WeaveLookup& lookup)
{
  std::string error;
  const std::optional<std::string> text = lookup(name, error);
  if (!text) throw InputError(error);
  Problems problems;
  const std::optional<Node> file = read_jsonc(*text, problems);
  if (!file || !file->is(Node::Type::object))
    throw InputError(
        fmt::format("weave '{}' is no JSON; `hauberk check` of an experiment with it says where", name));
  Weave weave;
  weave.name = name;
  if (const Node* about = file->find("description")) weave.description = about->string;
  weave.smallest_ratio = length_of(*file, "buildable", "at_least");
  const Node* parameters = file->find("parameters");
  if (parameters == nullptr || parameters->find("inner_diameter") == nullptr ||
      parameters->find("wire_diameter") == nullptr || !(weave.smallest_ratio > 0.0))
    throw InputError(fmt::format(
        "weave '{}' is not woven of plain rings: a maker's answers need the parameters inner_diameter and "
        "wire_diameter, and buildable.at_least; use `hauberk run` for its limits",
        name));
  if (const Node* ways = file->find("ways"); ways != nullptr && ways->is(Node::Type::object)) {
    for (const auto& [way, degrees] : ways->members) weave.ways.push_back({way, degrees.number});
  }
  if (weave.ways.empty()) weave.ways = {{"along x", 0.0}, {"along y", 90.0}};
  return weave;
}

bool can_be_woven(const Weave& weave, const Question& question)
{
  return question.inner / question.wire >= weave.smallest_ratio;
}

std::string experiment_text(const Weave& weave, const Question& question, double clearance)
{
  namespace json = boost::json;
  json::array directions;
  for (const Weave::Way& way : weave.ways) directions.push_back(way.degrees);
  std::string name;
  for (const char c : weave.name)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ? c : '_';
  json::object load{{"plugin", "in_plane_periodic"}, {"directions_deg", directions}};
  // A chain hangs on nothing beside it, and is as high as it is wide: it may shrink and swell across. With
  // its direction free as well (no shear held) it would turn aside instead of being pushed together.
  if (weave.ways.size() == 1) load["out_of_plane"] = "free";
  json::object document{
      {"name", name},
      {"task", "limits"},
      {"length_unit", "mm"},
      {"cell",
       json::object{{"weave", json::object{{"name", weave.name},
                                           {"parameters", json::object{{"inner_diameter", question.inner},
                                                                       {"wire_diameter", question.wire}}}}}}},
      {"load_case", std::move(load)}};
  if (clearance > 0.0) document["solver"] = json::object{{"clearance", clearance}};
  return write_json(document);
}

Sheet answer(const Weave& weave, const Question& question, const WeaveLookup& lookup,
             const std::shared_ptr<const Registry>& registry, unsigned threads, Progress& progress)
{
  Sheet sheet;
  sheet.question = question;
  sheet.weave = weave;
  sheet.ratio = question.inner / question.wire;
  sheet.smallest_inner = weave.smallest_ratio * question.wire;
  sheet.thickest_wire = question.inner / weave.smallest_ratio;
  sheet.chain = weave.ways.size() == 1;
  const double r = 0.5 * question.wire, R = 0.5 * question.inner + r;
  sheet.ring_volume = 2.0 * std::numbers::pi * std::numbers::pi * R * r * r;
  const Job job = job_of(weave, question, 0.0, lookup, registry);
  const SceneSpec& scene = job.prepared->scene;
  const auto count = static_cast<double>(scene.elements.size());
  const double area = std::abs(scene.lattice[0].cross(scene.lattice[1]).z());
  sheet.rings = sheet.chain ? count / pitch_along(scene.lattice, weave.ways[0].degrees) * metre
                            : count / area * square_decimetre;
  sheet.ways = answers(job, weave, threads, progress, "limits");
  if (question.roll && !sheet.chain)
    sheet.rolls = rolls(weave, question, scene.lattice, lookup, registry, threads, progress);
  // Surfaces that stay a gap apart are those of wire as much thicker that touch.
  const Question thicker{question.weave, question.inner - question.gap, question.wire + question.gap,
                         question.gap};
  sheet.printable = thicker.inner > 0.0 && can_be_woven(weave, thicker);
  if (sheet.printable)
    sheet.with_gap = answers(job_of(weave, question, question.gap, lookup, registry), weave, threads,
                             progress, "limits with the gap");
  return sheet;
}

const std::vector<Metal>& metals()
{
  static const std::vector<Metal> table{
      {"aluminium", 2.70}, {"titanium", 4.51}, {"steel", 7.85},  {"stainless steel", 8.00},
      {"brass", 8.50},     {"bronze", 8.80},   {"copper", 8.96}, {"sterling silver", 10.36}};
  return table;
}

std::string sheet_text(const Sheet& sheet)
{
  const Question& q = sheet.question;
  std::string text = fmt::format("{}: {}\n", sheet.weave.name, sheet.weave.description);
  text += fmt::format(
      "rings of {:.4g} mm inner diameter, wire of {:.4g} mm: ratio {:.3f}, at least {:.3f} is needed\n",
      q.inner, q.wire, sheet.ratio, sheet.weave.smallest_ratio);
  text += fmt::format("  this wire takes rings from {:.3f} mm on, these rings wire up to {:.3f} mm\n\n",
                      sheet.smallest_inner, sheet.thickest_wire);
  text += "the pattern repeats itself every\n" + ways_text(sheet.ways) + "\n" + rolls_text(sheet.rolls);
  const double weight = 1e-3 * sheet.rings * sheet.ring_volume;  // cm^3 per dm^2 or metre
  const char* per = sheet.chain ? "m" : "dm^2";
  text += fmt::format("{:.1f} rings per {} at rest; grams per {}:", sheet.rings, per, per);
  const char* separator = " ";
  for (const Metal& metal : metals()) {
    text += fmt::format("{}{} {:.1f}", separator, metal.name, weight * metal.density);
    separator = ", ";
  }
  text += "\n\n";
  if (!sheet.printable)
    return text +
           fmt::format("printed with a gap of {:g} mm it has no room: that takes rings from {:.3f} mm on\n",
                       q.gap, sheet.weave.smallest_ratio * (q.wire + q.gap) + q.gap);
  return text + fmt::format("printed, surfaces {:g} mm apart, every\n", q.gap) + ways_text(sheet.with_gap);
}

boost::json::object sheet_json(const Sheet& sheet)
{
  namespace json = boost::json;
  const Question& q = sheet.question;
  json::object grams;
  for (const Metal& metal : metals())
    grams[metal.name] = 1e-3 * sheet.rings * sheet.ring_volume * metal.density;
  json::object out{{"weave", sheet.weave.name},
                   {"inner_mm", q.inner},
                   {"wire_mm", q.wire},
                   {"ratio", sheet.ratio},
                   {"smallest_ratio", sheet.weave.smallest_ratio},
                   {"smallest_inner_mm", sheet.smallest_inner},
                   {"thickest_wire_mm", sheet.thickest_wire},
                   {"ways", ways_json(sheet.ways)},
                   {"rolls", rolls_json(sheet.rolls)},
                   {"rings", sheet.rings},
                   {"per", sheet.chain ? "m" : "dm2"},
                   {"grams", std::move(grams)},
                   {"gap_mm", q.gap},
                   {"printable", sheet.printable}};
  out["with_gap"] = ways_json(sheet.with_gap);
  return out;
}

}  // namespace hauberk::maker
