#include "strut_frame.hpp"

#include "capsule.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace hauberk {
namespace {

constexpr double smallest = 1e-12, largest = 1e12;
enum Parameter : std::size_t { size_, r_ };
constexpr std::size_t parameter_count = 2;

/// A right-handed frame whose third axis is `direction`.
Mat3 axes_along(const Vec3& direction)
{
  Mat3 axes;
  axes.col(2) = direction.normalized();
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

void check(const Graph& graph)
{
  std::set<std::pair<int, int>> known;
  for (std::size_t k = 0; k < graph.struts.size(); ++k) {
    const auto [a, b] = graph.struts[k];
    for (const int node : {a, b})
      if (node < 0 || node >= static_cast<int>(graph.nodes.size()))
        throw InputError(fmt::format("strut {} joins node {}, and there are {} nodes, counted from 0", k,
                                     node, graph.nodes.size()));
    if (!((graph.nodes[a] - graph.nodes[b]).norm() > 0.0))
      throw InputError(fmt::format("strut {} has no length: nodes {} and {} are at one place", k, a, b));
    if (!known.emplace(std::min(a, b), std::max(a, b)).second)
      throw InputError(fmt::format("strut {} joins nodes {} and {}, as another one does", k, a, b));
  }
}

}  // namespace

StrutFrame::StrutFrame(Graph graph)
    : parameters_{{"size", "length", std::numeric_limits<double>::quiet_NaN(), smallest, largest,
                   "length of a unit of the graph: of a polyhedron that of its edges", true},
                  {"r", "length", std::numeric_limits<double>::quiet_NaN(), smallest, largest,
                   "radius of the struts and of their round ends", true}}
{
  check(graph);
  for (const auto& [a, b] : graph.struts) {
    const Vec3 way = graph.nodes[b] - graph.nodes[a];
    struts_.push_back({0.5 * (graph.nodes[a] + graph.nodes[b]), 0.5 * way.norm(), axes_along(way)});
  }
}

void StrutFrame::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const Strut& s : struts_) shortest = std::min(shortest, 2.0 * s.half * p[size_]);
  if (!(p[r_] < 0.5 * shortest))
    throw InputError(
        fmt::format("r = {:g} is not below half the length of the shortest strut, {:g}: a cage has windows",
                    p[r_], shortest));
  std::vector<std::pair<double, std::shared_ptr<const Solid>>> made;  // struts of one length are one solid
  out.clear();
  for (std::size_t k = 0; k < struts_.size(); ++k) {
    const Strut& s = struts_[k];
    Primitive strut;
    strut.name = fmt::format("strut_{}", k);
    strut.kind = PrimitiveKind::solid;
    strut.position = p[size_] * s.middle;
    strut.rotation = s.axes;
    auto known = std::find_if(made.begin(), made.end(), [&](const auto& m) { return m.first == s.half; });
    if (known == made.end())
      known = made.emplace(known, s.half, std::make_shared<const Capsule>(p[size_] * s.half, p[r_]));
    strut.solid = known->second;
    out.push_back(std::move(strut));
  }
}

void StrutFrame::do_jacobians(std::span<const double> /*p*/, std::vector<PrimitiveJacobian>& out) const
{
  out.clear();
  for (const Strut& s : struts_) {
    PrimitiveJacobian j((primitive_dofs + 2) * parameter_count, 0.0);
    for (std::size_t i = 0; i < 3; ++i) j[i * parameter_count + size_] = s.middle[i];
    j[primitive_dofs * parameter_count + size_] = s.half;
    j[(primitive_dofs + 1) * parameter_count + r_] = 1.0;
    out.push_back(std::move(j));
  }
}

}  // namespace hauberk
