#include "limits/search_memory.hpp"

#include "numerics/fnv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>

namespace hauberk {
namespace {

void add(Fnv1a& hash, const double* x, Eigen::Index n)
{
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto bits = std::bit_cast<std::uint64_t>(x[k]);
    for (int byte = 0; byte < 64; byte += 8) hash.add(static_cast<unsigned char>(bits >> byte));
  }
}

bool fits(const Model& model, const State& state)
{
  return state.macro.size() == model.macro_count &&
         state.e.size() == static_cast<Eigen::Index>(model.element_count()) * model.coordinate_count &&
         state.rotation.size() == static_cast<std::size_t>(model.element_count());
}

bool fits(const Model& model, const ContactEnergy::Point& p)
{
  const auto within = [](int k, std::size_t count) { return k >= 0 && static_cast<std::size_t>(k) < count; };
  if (p.wall >= 0) return within(p.wall, model.walls.size()) && within(p.a, model.rest.size());
  return within(p.a, model.bodies.size()) && within(p.b, model.bodies.size());
}

bool fits(const Model& model, const ContactEnergy& pressed)
{
  const auto parameters = std::max_element(model.parameter_count.begin(), model.parameter_count.end());
  return pressed.gradient.size() == model.dofs() && pressed.parameters.cols() == model.element_count() &&
         pressed.parameters.rows() == (parameters == model.parameter_count.end() ? 0 : *parameters) &&
         std::all_of(pressed.points.begin(), pressed.points.end(),
                     [&model](const ContactEnergy::Point& p) { return fits(model, p); });
}

}  // namespace

bool fits(const Model& model, const Locked& locked)
{
  const auto of_model = [&model](const State& state) { return fits(model, state); };
  return (!locked.pressed || fits(model, *locked.pressed)) &&
         (locked.stage.tether.size() == 0 || locked.stage.tether.rows() == model.macro_count) &&
         of_model(locked.state) && std::all_of(locked.trail.begin(), locked.trail.end(), of_model) &&
         std::all_of(locked.path.begin(), locked.path.end(), of_model) &&
         locked.trail.size() <= locked.stages.size();
}

std::string name_of_state(const State& state)
{
  Fnv1a hash;
  add(hash, state.macro.data(), state.macro.size());
  add(hash, state.e.data(), state.e.size());
  for (const Mat3& Q : state.rotation) add(hash, Q.data(), Q.size());
  return fmt::format("{:016x}", hash.value());
}

}  // namespace hauberk
