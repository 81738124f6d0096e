#include "maker/weave_rings.hpp"

#include "document/json_text.hpp"
#include "document/jsonc.hpp"
#include "document/node_access.hpp"
#include "run/interrupt.hpp"
#include "run/prepared.hpp"
#include "run/variant_run.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>
#include <boost/json/parse.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace hauberk::maker {
namespace {

const Node* find_in(const Node& root, const char* outer, const char* name)
{
  const Node* section = root.find(outer);
  return section == nullptr ? nullptr : section->find(name);
}

double& value_of(Question& question, Diameter diameter)
{
  switch (diameter) {
    case Diameter::inner:
      return question.inner;
    case Diameter::wire:
      return question.wire;
    case Diameter::small_inner:
      return question.small->inner;
    case Diameter::small_wire:
      break;
  }
  return question.small->wire;
}

/// The question with another value of one diameter.
Question with(Question question, Diameter diameter, double value)
{
  const bool both = diameter == Diameter::wire && question.small && question.one_wire();
  value_of(question, diameter) = value;
  if (both) question.small->wire = value;
  return question;
}

constexpr double stride = 1.01, farthest = 8.0, resolution = 1e-10;

/// Links at rest. Throws InputError where there is no such scene, or no rest state.
std::size_t links_at_rest(const std::string& text, const WeaveSource& source)
{
  Diagnostics diagnostics;
  const std::optional<Experiment> experiment = read_experiment(
      {"weave " + source.weave.name, text, {}, source.lookup}, lookup_in(*source.registry), diagnostics);
  if (!experiment) throw ReportedProblems(diagnostics);
  return prepare_variant(*experiment).model.links.size();
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
  if (const Node* ratio = find_in(*file, "buildable", "at_least");
      ratio != nullptr && ratio->is(Node::Type::number))
    weave.smallest_ratio = ratio->number;
  const auto has = [&](const char* parameter) { return find_in(*file, "parameters", parameter) != nullptr; };
  weave.two_sizes = has("small_inner_diameter");
  if (weave.two_sizes != has("small_wire_diameter") || !has("inner_diameter") || !has("wire_diameter") ||
      !(weave.smallest_ratio > 0.0))
    throw InputError(fmt::format(
        "weave '{}' is not woven of plain rings: a maker's answers need the parameters inner_diameter and "
        "wire_diameter (of two sizes small_inner_diameter and small_wire_diameter, too), and buildable.at_least; use "
        "`hauberk run` for its limits",
        name));
  if (const Node* ways = file->find("ways"); ways != nullptr && ways->is(Node::Type::object)) {
    for (const auto& [way, degrees] : ways->members) weave.ways.push_back({way, degrees.number});
  }
  if (weave.ways.empty()) weave.ways = {{"along x", 0.0}, {"along y", 90.0}};
  return weave;
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
  json::object parameters{{"inner_diameter", question.inner}, {"wire_diameter", question.wire}};
  if (question.small) {
    parameters["small_inner_diameter"] = question.small->inner;
    parameters["small_wire_diameter"] = question.small->wire;
  }
  json::object document{
      {"name", name},
      {"task", "limits"},
      {"length_unit", "mm"},
      {"cell",
       json::object{{"weave", json::object{{"name", weave.name}, {"parameters", std::move(parameters)}}}}},
      {"load_case", std::move(load)}};
  if (clearance > 0.0) document["solver"] = json::object{{"clearance", clearance}};
  return write_json(document);
}

RingFit::RingFit(WeaveSource source) : source_(std::move(source))
{
  if (!source_.weave.two_sizes) return;
  namespace json = boost::json;
  json::value own = json::parse(experiment_text(source_.weave, {}, 0.0));
  own.at("cell").at("weave").as_object().erase("parameters");
  try {
    links_ = links_at_rest(write_json(own), source_);
  } catch (const ReportedProblems&) {
    throw;
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("weave '{}', with the sizes of its file: {}", source_.weave.name, error.what()));
  }
}

bool RingFit::fits(const Question& question) const
{
  const Weave& weave = source_.weave;
  if (!weave.two_sizes) return question.inner / question.wire >= weave.smallest_ratio;
  try {
    return links_at_rest(experiment_text(weave, question, 0.0), source_) == links_;
  } catch (const InputError&) {
    return false;
  }
}

std::optional<Range> RingFit::range(const Question& question, Diameter diameter) const
{
  const Weave& weave = source_.weave;
  if (!weave.two_sizes)
    return diameter == Diameter::inner ? Range{weave.smallest_ratio * question.wire}
                                       : Range{0.0, question.inner / weave.smallest_ratio};
  Question asked = question;
  const double value = value_of(asked, diameter);
  const auto has_room = [&](double x) {
    if (interrupted()) throw ComputationError("interrupted");
    return fits(with(question, diameter, x));
  };
  // The nearest value with room, by steps to both sides.
  std::optional<double> inside;
  for (double factor = 1.0; factor <= farthest && !inside; factor *= stride) {
    for (const double x : {value * factor, value / factor})
      if (!inside && has_room(x)) inside = x;
  }
  if (!inside) return std::nullopt;
  // From there on to the first value without, and back by halves.
  const auto end = [&](double step) -> std::optional<double> {
    double in = *inside, out = in * step;
    for (; has_room(out); out *= step) {
      if (out > farthest * value || out < value / farthest) return std::nullopt;
      in = out;
    }
    while (std::abs(out - in) > 0.5 * resolution * value) {
      const double middle = 0.5 * (in + out);
      (has_room(middle) ? in : out) = middle;
    }
    return in;
  };
  Range found;
  found.low = end(1.0 / stride).value_or(found.low);
  found.high = end(stride).value_or(found.high);
  return found;
}

Fitting RingFit::fitting(const Question& question) const
{
  Fitting out;
  out.inner = range(question, Diameter::inner);
  out.wire = range(question, Diameter::wire);
  out.two_sizes = question.small.has_value();
  if (out.two_sizes) out.small_inner = range(question, Diameter::small_inner);
  if (!question.one_wire()) out.small_wire = range(question, Diameter::small_wire);
  return out;
}

std::string fitting_text(const Fitting& fitting)
{
  std::vector<std::string> parts;
  const auto add = [&](const std::string& what, const std::optional<Range>& range) {
    if (!range) return;
    // Inwards, but for what rounding made of a number of so many digits.
    constexpr double digits = 1e3, rounding = 1e-6;
    const double low = std::ceil(range->low * digits - rounding) / digits;
    const double high = std::floor(range->high * digits + rounding) / digits;
    if (std::isinf(high))
      parts.push_back(low <= 0.0 ? "any " + what : fmt::format("{} from {:.3f} mm on", what, low));
    else if (low <= 0.0)
      parts.push_back(fmt::format("{} up to {:.3f} mm", what, high));
    else
      parts.push_back(fmt::format("{} from {:.3f} to {:.3f} mm", what, low, high));
  };
  add(fitting.two_sizes ? "large rings" : "rings", fitting.inner);
  add("small rings", fitting.small_inner);
  add(fitting.small_wire ? "wire of the large rings" : "wire", fitting.wire);
  add("wire of the small rings", fitting.small_wire);
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k)
    text += (k == 0 ? "" : k + 1 < parts.size() ? ", " : ", or ") + parts[k];
  return text;
}

std::string rings_text(const Question& question)
{
  if (!question.small)
    return fmt::format("rings of {:.4g} mm, wire of {:.4g} mm", question.inner, question.wire);
  const std::string wires =
      question.one_wire() ? fmt::format("wire of {:.4g} mm", question.wire)
                          : fmt::format("wire of {:.4g} and {:.4g} mm", question.wire, question.small->wire);
  return fmt::format("large rings of {:.4g} mm, small ones of {:.4g} mm, {}", question.inner,
                     question.small->inner, wires);
}

}  // namespace hauberk::maker
