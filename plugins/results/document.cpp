#include "results/document.hpp"

#include "document/json_text.hpp"
#include "results/json_parts.hpp"

namespace hauberk {
namespace {

namespace json = boost::json;
using detail::number;

}  // namespace

json::object provenance_json(const Provenance& provenance)
{
  json::object out;
  out["version"] = provenance.version;
  out["build"] = {{"type", provenance.build_type}, {"compiler", provenance.compiler}};
  json::object& libraries = out["libraries"].emplace_object();
  for (const auto& [name, version] : provenance.libraries) libraries[name] = version;
  json::array& plugins = out["plugins"].emplace_array();
  for (const Provenance::Plugin& plugin : provenance.plugins)
    plugins.push_back({{"id", plugin.id},
                       {"kind", plugin.kind},
                       {"version", plugin.version},
                       {"file", plugin.file},
                       {"sha256", plugin.sha256}});
  if (!provenance.weaves.empty()) {
    json::object& weaves = out["weaves"].emplace_object();
    for (const auto& [name, text] : provenance.weaves) weaves[name] = text;
  }
  if (!provenance.files.empty()) {
    json::object& files = out["files"].emplace_object();
    for (const auto& [path, fingerprint] : provenance.files) files[path] = fingerprint;
  }
  out["seed"] = provenance.seed;
  out["threads"] = provenance.threads;
  out["peak_memory_bytes"] = provenance.peak_memory_bytes;
  if (!provenance.processors.empty())
    out["processors"] = json::array(provenance.processors.begin(), provenance.processors.end());
  if (const std::optional<Machine>& machine = provenance.machine) {
    out["machine"] = {{"processor", machine->processor},
                      {"processors", machine->processors},
                      {"load_average", number(machine->load_average)}};
  }
  return out;
}

namespace {

json::array profiles_json(const std::vector<ProfilePoint>& profiles)
{
  json::array out;
  for (const ProfilePoint& p : profiles)
    out.push_back({{"direction_deg", number(p.direction_deg)},
                   {"e_s", number(p.e_s)},
                   {"e_c", number(p.e_c)},
                   {"eta", number(p.eta)}});
  return out;
}

json::object boundary_json(const BoundarySurface& boundary)
{
  json::object out;
  json::array& triangles = out["triangles"].emplace_array();
  for (const Triangle& t : boundary.triangles) triangles.push_back({t[0], t[1], t[2]});
  out["margin"] = number(boundary.margin);
  json::array& shortfalls = out["shortfalls"].emplace_array();
  for (const BoundarySurface::Shortfall& s : boundary.shortfalls)
    shortfalls.push_back({{"limit", s.limit}, {"state", s.state}, {"by", number(s.by)}});
  return out;
}

json::array variables_json(const std::vector<DesignVariableResult>& variables)
{
  json::array out;
  for (const DesignVariableResult& v : variables)
    out.push_back({{"name", v.name},
                   {"initial", number(v.initial)},
                   {"final", number(v.final)},
                   {"lower", number(v.lower)},
                   {"upper", number(v.upper)},
                   {"elements", json::array(v.elements.begin(), v.elements.end())}});
  return out;
}

json::array targets_json(const std::vector<DesignTargetResult>& targets)
{
  json::array out;
  for (const DesignTargetResult& t : targets)
    out.push_back({{"direction_deg", number(t.direction_deg)},
                   {"target", number(t.target)},
                   {"weight", number(t.weight)},
                   {"aim", to_string(t.aim)},
                   {"initial", number(t.initial)},
                   {"provisional", number(t.provisional)},
                   {"recomputed", number(t.recomputed)},
                   {"better_state", t.better_state},
                   {"met", t.met}});
  return out;
}

json::array history_json(const std::vector<DesignIterate>& history)
{
  json::array out;
  for (const DesignIterate& h : history) {
    json::array variables, values;
    for (const double x : h.variables) variables.push_back(number(x));
    for (const double value : h.values) values.push_back(number(value));
    out.push_back({{"iteration", h.iteration},
                   {"objective", number(h.objective)},
                   {"step", number(h.step)},
                   {"optimality", number(h.optimality)},
                   {"constraint_violation", number(h.constraint_violation)},
                   {"min_gap", number(h.min_gap)},
                   {"links_kept", h.links_kept},
                   {"changed", json::array(h.changed.begin(), h.changed.end())},
                   {"seconds", number(h.seconds)},
                   {"variables", std::move(variables)},
                   {"values", std::move(values)}});
  }
  return out;
}

json::object design_json(const DesignResult& design, const std::vector<std::string>& macro_names)
{
  json::object out;
  out["quantity"] = design.quantity;
  out["status"] = design.status;
  out["message"] = design.message;
  out["objective_initial"] = number(design.objective_initial);
  out["objective"] = number(design.objective);
  out["iterations"] = design.iterations;
  out["evaluations"] = static_cast<std::int64_t>(design.evaluations);
  out["seconds"] = number(design.seconds);
  out["variables"] = variables_json(design.variables);
  out["targets"] = targets_json(design.targets);
  out["start"] = design.start;
  json::array& starts = out["starts"].emplace_array();
  for (const auto& [start, objective] : design.starts)
    starts.push_back({{"start", start}, {"objective", number(objective)}});
  out["history"] = history_json(design.history);
  json::object& initial = out["initial"].emplace_object();
  initial["scene"] = detail::scene_json(design.initial_scene);
  initial["limits"] = detail::limits_json(design.initial_limits, macro_names);
  return out;
}

}  // namespace

std::optional<LimitStatus> limit_status(const std::string& name)
{
  for (const LimitStatus status : all_limit_statuses) {
    if (to_string(status) == name) return status;
  }
  return std::nullopt;
}

json::object document_without_results(const std::string& experiment_json, const Provenance& provenance,
                                      json::value plan, const SceneSpec& scene)
{
  json::object out;
  out["format"] = results_format;
  out["experiment"] = parse_json(experiment_json, "resolved experiment");
  out["provenance"] = provenance_json(provenance);
  out["plan"] = std::move(plan);
  out["scene"] = detail::scene_json(scene);
  out["limits"] = json::array();
  out["profiles"] = json::array();
  out["design"] = nullptr;
  return out;
}

void enter_run(json::object& document, const RunResult& run, const std::vector<std::string>& macro_names)
{
  document["scene"] = detail::scene_json(run.scene);
  document["limits"] = detail::limits_json(run.limits, macro_names);
  document["profiles"] = profiles_json(run.profiles);
  document["design"] = run.design ? json::value(design_json(*run.design, macro_names)) : json::value(nullptr);
  if (run.boundary) document["boundary"] = boundary_json(*run.boundary);
}

json::object results_document(const RunResult& run, const std::string& experiment_json,
                              const std::vector<std::string>& macro_names)
{
  json::object out = document_without_results(experiment_json, {}, nullptr, run.scene);
  enter_run(out, run, macro_names);
  out["files"].emplace_object();
  return out;
}

}  // namespace hauberk
