#include "tasks/transition/transition_results.hpp"

#include "results/csv_cells.hpp"
#include "results/json_parts.hpp"

#include <algorithm>

namespace hauberk {
namespace {

namespace json = boost::json;
using detail::number;
using detail::number_cell;
using detail::vector_json;

json::object jump_json(const TransitionJump& jump)
{
  return {
      {"relative", number(jump.relative)}, {"at", number(jump.at)}, {"resolution", number(jump.resolution)}};
}

json::object curve_json(const TransitionCurve& curve)
{
  json::object out;
  out["contact"] = curve.contact;
  out["formulation"] = curve.formulation;
  out["largest_energy"] = number(curve.largest_energy);
  out["largest_force"] = number(curve.largest_force);
  out["energy_jump"] = jump_json(curve.energy);
  out["force_jump"] = jump_json(curve.force);
  out["quadrature_error"] = nullptr;
  if (curve.quadrature)
    out["quadrature_error"] = {{"energy", number(curve.quadrature->first)},
                               {"force", number(curve.quadrature->second)}};
  out["evaluations"] = curve.evaluations;
  return out;
}

json::object minimum_json(const TransitionMinimum& m)
{
  return {{"contact", m.contact},
          {"primitives", {m.primitives[0], m.primitives[1]}},
          {"distance", number(m.distance)},
          {"eigenvalue", number(m.eigenvalue)},
          {"relative_curvature", number(m.relative_curvature)},
          {"points", {vector_json(m.on_fixed), vector_json(m.on_moving)}}};
}

json::object force_json(const TransitionForce& f)
{
  json::array wrench;
  for (const double x : f.wrench) wrench.push_back(number(x));
  return {{"energy", number(f.energy)}, {"along", number(f.along)}, {"wrench", std::move(wrench)}};
}

json::object sample_json(const TransitionSample& sample)
{
  json::array minima, forces;
  for (const TransitionMinimum& m : sample.minima) minima.push_back(minimum_json(m));
  for (const TransitionForce& f : sample.forces) forces.push_back(force_json(f));
  return {{"s", number(sample.s)},
          {"degrees", number(sample.degrees)},
          {"shift", number(sample.shift)},
          {"minima", std::move(minima)},
          {"forces", std::move(forces)}};
}

/// Where contacts exist: number, first and last s.
json::array contacts_json(const TransitionPath& path)
{
  struct Span {
    double from = 0.0, to = 0.0;
  };
  std::vector<Span> spans;
  for (const TransitionSample& sample : path.samples) {
    for (const TransitionMinimum& m : sample.minima) {
      const std::size_t k = m.contact;
      if (k >= spans.size()) spans.resize(k + 1, {sample.s, sample.s});
      spans[k].to = sample.s;
    }
  }
  json::array out;
  for (std::size_t k = 0; k < spans.size(); ++k)
    out.push_back({{"contact", k}, {"from", number(spans[k].from)}, {"to", number(spans[k].to)}});
  return out;
}

/// The smallest of a quantity over the minima of a sample; empty where there are none.
template <typename F>
std::optional<double> smallest(const TransitionSample& sample, F&& quantity)
{
  std::optional<double> out;
  for (const TransitionMinimum& m : sample.minima) {
    const std::optional<double> x = quantity(m);
    if (x && (!out || *x < *out)) out = x;
  }
  return out;
}

}  // namespace

json::object transition_json(const TransitionResult& result)
{
  json::object out;
  out["activation_distance"] = number(result.activation_distance);
  out["range"] = number(result.range);
  out["length"] = number(result.length);
  out["message"] = result.message;
  out["eigenvalue_threshold"] = number(result.eigenvalue_threshold);
  json::array& paths = out["paths"].emplace_array();
  for (const TransitionPath& path : result.paths) {
    std::size_t most = 0;
    for (const TransitionSample& sample : path.samples) most = std::max(most, sample.minima.size());
    json::object& entry = paths.emplace_back(json::object{}).as_object();
    entry["name"] = path.name;
    entry["most_minima"] = most;
    entry["contacts"] = contacts_json(path);
    json::array& curves = entry["curves"].emplace_array();
    for (const TransitionCurve& curve : path.curves) curves.push_back(curve_json(curve));
    json::array& samples = entry["samples"].emplace_array();
    for (const TransitionSample& sample : path.samples) samples.push_back(sample_json(sample));
  }
  return out;
}

std::string transition_csv(const TransitionResult& result)
{
  std::vector<std::string> header{"path",   "step",     "s",          "degrees",           "shift",
                                  "minima", "distance", "eigenvalue", "relative_curvature"};
  if (!result.paths.empty()) {
    for (const TransitionCurve& curve : result.paths.front().curves) {
      for (const char* what : {"energy", "along", "fx", "fy", "fz", "tx", "ty", "tz"})
        header.push_back(curve.contact + "_" + what);
    }
  }
  std::string out = detail::csv_line(header);
  for (const TransitionPath& path : result.paths) {
    for (std::size_t k = 0; k < path.samples.size(); ++k) {
      const TransitionSample& s = path.samples[k];
      std::vector<std::string> cells{
          detail::text_cell(path.name), std::to_string(k),    number_cell(s.s),
          number_cell(s.degrees),       number_cell(s.shift), std::to_string(s.minima.size())};
      cells.push_back(number_cell(smallest(s, [](const auto& m) { return std::optional(m.distance); })));
      cells.push_back(number_cell(smallest(s, [](const auto& m) { return m.eigenvalue; })));
      cells.push_back(
          number_cell(smallest(s, [](const auto& m) { return std::optional(m.relative_curvature); })));
      for (const TransitionForce& f : s.forces) {
        cells.push_back(number_cell(f.energy));
        cells.push_back(number_cell(f.along));
        for (const double x : f.wrench) cells.push_back(number_cell(x));
      }
      out += detail::csv_line(cells);
    }
  }
  return out;
}

std::string transition_minima_csv(const TransitionResult& result)
{
  std::string out = detail::csv_line({"path", "step", "s", "contact", "fixed_primitive", "moving_primitive",
                                      "distance", "eigenvalue", "relative_curvature", "fixed_x", "fixed_y",
                                      "fixed_z", "moving_x", "moving_y", "moving_z"});
  for (const TransitionPath& path : result.paths) {
    for (std::size_t k = 0; k < path.samples.size(); ++k) {
      for (const TransitionMinimum& m : path.samples[k].minima) {
        std::vector<std::string> cells{detail::text_cell(path.name),     std::to_string(k),
                                       number_cell(path.samples[k].s),   std::to_string(m.contact),
                                       std::to_string(m.primitives[0]),  std::to_string(m.primitives[1]),
                                       number_cell(m.distance),          number_cell(m.eigenvalue),
                                       number_cell(m.relative_curvature)};
        for (const Vec3* x : {&m.on_fixed, &m.on_moving}) {
          for (int i = 0; i < 3; ++i) cells.push_back(number_cell((*x)[i]));
        }
        out += detail::csv_line(cells);
      }
    }
  }
  return out;
}

}  // namespace hauberk
