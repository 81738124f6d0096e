#include "maker/weave_rings.hpp"

#include "document/json_text.hpp"
#include "document/jsonc.hpp"
#include "document/node_access.hpp"
#include "run/prepared.hpp"
#include "run/variant_run.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

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

constexpr double stride = 1.01, farthest = 8.0, resolution = 1e-4;

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
  weave.two_sizes = has("small_inner_diameter") && has("small_wire_diameter");
  if (!has("inner_diameter") || !has("wire_diameter") || !(weave.smallest_ratio > 0.0))
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

RingFit::RingFit(Weave weave, WeaveLookup lookup, std::shared_ptr<const Registry> registry)
    : weave_(std::move(weave)), lookup_(std::move(lookup)), registry_(std::move(registry))
{
  if (!weave_.two_sizes) return;
  std::string error;
  Problems problems;
  const Node file = read_jsonc(lookup_(weave_.name, error).value(), problems).value();
  const auto size = [&](const char* name) {
    const Node* value = file.at("parameters").at(name).find("default");
    return value == nullptr ? 0.0 : value->number;
  };
  Question own{weave_.name, size("inner_diameter"), size("wire_diameter")};
  own.small = Ring{size("small_inner_diameter"), size("small_wire_diameter")};
  links_ = links(own);
}

/// Links at rest; 0 where there is no rest state.
std::size_t RingFit::links(const Question& question) const
{
  Diagnostics diagnostics;
  try {
    const std::optional<Experiment> experiment = read_experiment(
        {"weave", experiment_text(weave_, question, 0.0), {}, lookup_}, lookup_in(*registry_), diagnostics);
    return experiment ? prepare_variant(*experiment).model.links.size() : 0;
  } catch (const InputError&) {
    return 0;
  }
}

bool RingFit::fits(const Question& question) const
{
  if (!weave_.two_sizes) return question.inner / question.wire >= weave_.smallest_ratio;
  const std::size_t found = links(question);
  return found > 0 && found == links_;
}

std::optional<Range> RingFit::range(const Question& question, Diameter diameter) const
{
  if (!weave_.two_sizes)
    return diameter == Diameter::inner ? Range{weave_.smallest_ratio * question.wire}
                                       : Range{0.0, question.inner / weave_.smallest_ratio};
  Question asked = question;
  const double value = value_of(asked, diameter);
  const auto has_room = [&](double x) { return fits(with(question, diameter, x)); };
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

std::string RingFit::ranges_text(const Question& question) const
{
  std::vector<std::string> parts;
  const auto add = [&](const std::string& what, Diameter diameter) {
    const std::optional<Range> found = range(question, diameter);
    if (!found) return;
    if (found->low <= 0.0)
      parts.push_back(fmt::format("{} up to {:.3f} mm", what, found->high));
    else if (std::isinf(found->high))
      parts.push_back(fmt::format("{} from {:.3f} mm on", what, found->low));
    else
      parts.push_back(fmt::format("{} from {:.3f} to {:.3f} mm", what, found->low, found->high));
  };
  add(weave_.two_sizes ? "large rings" : "rings", Diameter::inner);
  if (weave_.two_sizes) add("small rings", Diameter::small_inner);
  add("wire", Diameter::wire);
  if (!question.one_wire()) add("wire of the small rings", Diameter::small_wire);
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
