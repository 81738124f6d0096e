#include "model/model.hpp"
#include "results/direction_json.hpp"
#include "results/json_parts.hpp"

#include <boost/json/value_from.hpp>

namespace hauberk::detail {
namespace {

namespace json = boost::json;

json::value macro_json(const std::vector<std::pair<std::string, double>>& macro)
{
  if (macro.empty()) return nullptr;  // no state was reached
  return named_numbers(macro);
}

json::object start_json(const LockedState& state, const std::vector<std::string>& names)
{
  json::object out;
  out["value"] = number(state.value);
  json::object& macro = out["macro"].emplace_object();
  for (std::size_t i = 0; i < state.macro.size(); ++i)
    macro[i < names.size() ? names[i] : std::to_string(i)] = number(state.macro[i]);
  out["z_range"] = number(state.z_range);
  out["origin"] = state.origin;
  out["seed"] = state.seed;
  out["count"] = state.count;
  return out;
}

json::object confidence_json(const Confidence& confidence)
{
  json::object out;
  out["word"] = confidence.word;
  out["searches"] = confidence.searches;
  out["ended_here"] = confidence.ended_here;
  out["distinct"] = confidence.distinct;
  out["seen_once"] = confidence.seen_once;
  out["confirmed_by"] = json::value_from(confidence.confirmed_by);
  out["contradicted_by"] = json::value_from(confidence.contradicted_by);
  json::array& failed = out["failed_searches"].emplace_array();
  for (const FailedSearch& search : confidence.failed_searches)
    failed.push_back(json::object{{"origin", search.origin},
                                  {"seed", search.seed},
                                  {"status", search.status},
                                  {"reached", number(search.reached)}});
  return out;
}

json::object contact_json(const ContactForce& contact)
{
  json::object out;
  out["elements"] = {contact.elements[0], contact.elements[1]};
  out["primitives"] = {contact.primitives[0], contact.primitives[1]};
  out["image"] = json::value_from(shown(contact.image));
  if (!contact.wall.empty()) out["wall"] = contact.wall;
  out["points"] = {vector_json(contact.points[0]), vector_json(contact.points[1])};
  out["normal"] = vector_json(contact.normal);
  out["gap"] = number(contact.gap);
  out["force"] = number(contact.force);
  return out;
}

/// [towards smaller, towards larger]; null where there is no room that way.
json::array pair_json(const LimitResult::OneSided& sides) { return {number(sides[0]), number(sides[1])}; }

json::object one_sided_json(const LimitResult& limit)
{
  json::object out;
  out["clearance"] = pair_json(limit.clearance_one_sided);
  json::object& parameters = out["parameters"].emplace_object();
  for (std::size_t k = 0; k < limit.parameters_one_sided.size(); ++k)
    parameters[limit.sensitivity_parameters[k].first] = pair_json(limit.parameters_one_sided[k]);
  return out;
}

json::array witness_json(const std::vector<WitnessState>& witness)
{
  json::array out;
  for (const WitnessState& state : witness) {
    json::object entry;
    entry["macro"] = macro_json(state.macro);
    json::array& poses = entry["poses"].emplace_array();
    for (const Pose& pose : state.poses) poses.push_back(pose_json(pose));
    out.push_back(std::move(entry));
  }
  return out;
}

}  // namespace

json::object limit_json(const LimitResult& limit, const std::vector<std::string>& macro_names)
{
  json::object out;
  out["load_case"] = limit.load_case;
  enter_direction(out, limit.direction);
  out["sense"] = limit.sense;
  out["measure"] = limit.measure;
  out["value"] = number(limit.value);
  for (const auto& [name, value] : limit.companions) out[name] = number(value);
  out["macro"] = macro_json(limit.macro);
  out["status"] = to_string(limit.status);
  out["message"] = limit.message;
  out["infimum"] = number(limit.infimum);
  out["iterations"] = limit.iterations;
  out["evaluations"] = static_cast<std::int64_t>(limit.evaluations);
  out["seconds"] = number(limit.seconds);
  out["min_gap"] = number(limit.min_gap);
  out["error_estimate"] = number(limit.error_estimate);
  out["links_kept"] = limit.links_kept;
  out["z_range"] = number(limit.z_range);
  out["contact"] = limit.contact;
  if (limit.quadrature_error) out["quadrature_error"] = number(limit.quadrature_error);
  if (limit.finite_target) out["finite_target"] = number(limit.finite_target);
  out["certificate"] = limit.certificate;

  std::vector<std::string> names;
  for (const auto& [name, value] : limit.macro) names.push_back(name);
  json::array& starts = out["starts"].emplace_array();
  for (const LockedState& state : limit.starts)
    starts.push_back(start_json(state, names.empty() ? macro_names : names));
  out["better_state"] = limit.better_state;
  out["confidence"] = confidence_json(limit.confidence);

  json::object& sensitivity = out["sensitivity"].emplace_object();
  sensitivity["clearance"] = number(limit.sensitivity_clearance);
  sensitivity["parameters"] = named_numbers(limit.sensitivity_parameters);

  out["kink"] = limit.kink;
  if (limit.kink) out["sensitivity_one_sided"] = one_sided_json(limit);

  json::array& poses = out["poses"].emplace_array();
  for (const Pose& pose : limit.poses) poses.push_back(pose_json(pose));
  json::array& contacts = out["contacts"].emplace_array();
  for (const ContactForce& contact : limit.contacts) contacts.push_back(contact_json(contact));
  out["force_balance"] = number(limit.force_balance);
  out["hold"] = json::value_from(limit.hold);
  json::array& reactions = out["reactions"].emplace_array();
  for (const auto& [name, value] : limit.reactions)
    reactions.push_back(json::object{{"name", name}, {"value", number(value)}});
  if (!limit.witness.empty()) out["witness"] = witness_json(limit.witness);
  return out;
}

json::array limits_json(std::span<const LimitResult> limits, const std::vector<std::string>& macro_names)
{
  json::array out;
  for (const LimitResult& limit : limits) out.push_back(limit_json(limit, macro_names));
  return out;
}

}  // namespace hauberk::detail
