#include "symmetric_scenes.hpp"

#include "shapes/strut_frame/strut_frame.hpp"

namespace hauberk::test {
namespace {

/// A tube around a trefoil knot; its radius is the parameter.
class Trefoil final : public Shape {
 public:
  Trefoil()
  {
    ParameterInfo r;
    r.name = "r";
    r.unit = "length";
    r.default_value = 0.3;
    r.lower = 0.01;
    r.upper = 1.0;
    parameters_.push_back(r);
  }

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    // (sin u + 2 sin 2u, cos u - 2 cos 2u, -sin 3u)
    Primitive knot;
    knot.name = "knot";
    knot.kind = PrimitiveKind::curve_tube;
    knot.size = {0.0, p[0], p[0]};
    knot.curve.resize(3);
    knot.curve[0] = {Vec3(0, 1, 0), Vec3(1, 0, 0)};
    knot.curve[1] = {Vec3(0, -2, 0), Vec3(2, 0, 0)};
    knot.curve[2] = {Vec3(0, 0, 0), Vec3(0, 0, -1)};
    out.push_back(knot);
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    PrimitiveJacobian j(primitive_dofs + 3 * harmonic_dofs, 0.0);
    j[4] = j[5] = 1.0;
    out.push_back(j);
  }

 private:
  std::vector<ParameterInfo> parameters_;
};

std::shared_ptr<const Shape> cross()
{
  const double quarter = 0.5 * std::numbers::pi;
  return std::make_shared<Rings>(std::vector<Rings::Ring>{{Vec3::Zero(), Mat3::Identity()},
                                                          {Vec3::Zero(), rotation_exp(Vec3(quarter, 0, 0))},
                                                          {Vec3::Zero(), rotation_exp(Vec3(0, quarter, 0))}});
}

std::vector<double> three_times(double R, double r) { return {R, r, r, R, r, r, R, r, r}; }

}  // namespace

SceneSpec repeated(const SceneSpec& cell, int m, int n)
{
  SceneSpec s = cell;
  s.elements.clear();
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      for (PlacedElement e : cell.elements) {
        e.rest.position += i * cell.lattice[0] + j * cell.lattice[1];
        s.elements.push_back(e);
      }
    }
  }
  s.lattice = {m * cell.lattice[0], n * cell.lattice[1]};
  s.repeat = {m, n, 1};
  return s;
}

SceneSpec fourfold()
{
  constexpr double R = 5.0, eighth = 0.25 * std::numbers::pi;
  SceneSpec s;
  s.types.push_back({"cross", cross()});
  const std::vector<double> p = three_times(R, 0.815);
  s.elements.push_back({0, p, {Vec3::Zero(), Mat3::Identity()}});
  s.elements.push_back({0, p, {Vec3(1.51 * R, 0, 0), rotation_exp(Vec3(eighth, 0, 0))}});
  s.elements.push_back({0, p, {Vec3(0, 1.51 * R, 0), rotation_exp(Vec3(0, eighth, 0))}});
  s.lattice = {Vec3(3.02 * R, 0, 0), Vec3(0, 3.02 * R, 0)};
  return s;
}

SceneSpec tall_tubes()
{
  constexpr double eighth = 0.25 * std::numbers::pi;
  const Vec3 x(eighth, 0, 0), y(0, eighth, 0);
  SceneSpec s;
  s.types.push_back({"cross", cross()});
  const auto place = [&s](double R, double r0, double r1, const Vec3& at, const Vec3& turn) {
    std::vector<double> p;
    for (int ring = 0; ring < 3; ++ring) p.insert(p.end(), {R, r0, r1});
    s.elements.push_back({0, p, {at, rotation_exp(turn)}});
  };
  place(5.24071763, 0.35, 0.823876029, Vec3(0.529295829, 0, 0), Vec3::Zero());
  place(4.80942396, 0.35, 1.59338083, Vec3(7.87286064, 0, 0), x);
  place(4.9752623, 0.35, 1.71930285, Vec3(0.655890028, 7.493, 0), y);
  place(5.23688775, 0.35, 1.11518028, Vec3(14.7318551, 0, 0), Vec3::Zero());
  place(5.19765349, 0.35, 0.8618115, Vec3(21.3155826, 0, 0), x);
  place(4.83820563, 0.405876043, 1.33897609, Vec3(14.8385158, 7.493, 0), y);
  s.lattice = {Vec3(29.972, 0, 0), Vec3(0, 14.986, 0)};
  return s;
}

SceneSpec japanese(bool triangular)
{
  constexpr double R = 4.9, quarter = 0.5 * std::numbers::pi;
  const double a = triangular ? 3.0 * R : std::sqrt(8.0) * R;
  SceneSpec s;
  s.types.push_back({"ring", std::make_shared<Rings>()});
  const std::vector<double> p{R, 0.7, 0.7};
  s.elements.push_back({0, p, {Vec3::Zero(), Mat3::Identity()}});
  const auto join = [&](double degrees) {
    const Vec3 along(std::cos(degrees * degree), std::sin(degrees * degree), 0.0);
    s.elements.push_back({0, p, {0.5 * a * along, rotation_exp(quarter * along)}});
  };
  join(0.0);
  if (triangular) {
    join(60.0);
    join(120.0);
    s.lattice = {Vec3(a, 0, 0), Vec3(0.5 * a, std::sqrt(0.75) * a, 0)};
  } else {
    join(90.0);
    s.lattice = {Vec3(a, 0, 0), Vec3(0, a, 0)};
  }
  return s;
}

SceneSpec threefold_patch()
{
  SceneSpec s = threefold_round();
  const PlacedElement centre = s.elements.front();
  for (int k = 0; k < 6; ++k) {
    PlacedElement e = centre;
    const double a = (30.0 + 60.0 * k) * degree;
    e.rest.position = threefold_spacing * Vec3(std::cos(a), std::sin(a), 0.0);
    s.elements.push_back(e);
  }
  s.lattice.clear();
  return s;
}

SceneSpec cubic()
{
  SceneSpec s;
  s.types.push_back({"cross", cross()});
  s.elements.push_back({0, three_times(5.0, 0.8), {Vec3::Zero(), Mat3::Identity()}});
  s.lattice = {Vec3(13, 0, 0), Vec3(0, 13, 0), Vec3(0, 0, 13)};
  return s;
}

SceneSpec trefoils()
{
  constexpr double a = 5.7;
  SceneSpec s;
  s.types.push_back({"trefoil", std::make_shared<Trefoil>()});
  s.elements.push_back({0, {0.3}, {Vec3::Zero(), Mat3::Identity()}});
  s.lattice = {Vec3(a * std::cos(30.0 * degree), 0.5 * a, 0.0), Vec3(0.0, a, 0.0)};
  return s;
}

namespace {

std::shared_ptr<const Shape> cage(const char* name)
{
  for (const Polyhedron& p : polyhedra())
    if (p.name == std::string_view(name)) return std::make_shared<StrutFrame>(p.graph());
  return nullptr;
}

/// Cages with edges of length 10, one at the origin and, if there are two turns, one at `second`.
SceneSpec cages(const char* name, const std::vector<Vec3>& lattice, const std::vector<Vec3>& turns,
                const Vec3& second)
{
  SceneSpec s;
  s.types.push_back({name, cage(name)});
  for (const Vec3& turn : turns)
    s.elements.push_back(
        {0, {10.0, 0.5}, {s.elements.empty() ? Vec3(Vec3::Zero()) : second, rotation_exp(turn)}});
  s.lattice = lattice;
  return s;
}

}  // namespace

SceneSpec diamond()
{
  return cages("tetrahedron", {Vec3(0, 8, 8), Vec3(8, 0, 8), Vec3(8, 8, 0)},
               {Vec3(0, 0, 45.0 * degree), Vec3(0, 0, 135.0 * degree)}, Vec3(4, 4, 4));
}

SceneSpec truncated_tetrahedra()
{
  return cages("truncated_tetrahedron", {Vec3(19.5, 0, 0), Vec3(0, 19.5, 0), Vec3(0, 0, 19.5)},
               {Vec3::Zero()}, Vec3::Zero());
}

SceneSpec octahedra_solid()
{
  const Vec3 turn = 25.0 * degree * Vec3(1, 1, 1).normalized();
  return cages("octahedron", {Vec3(0, 8.2, 8.2), Vec3(8.2, 0, 8.2), Vec3(8.2, 8.2, 0)}, {turn, -turn},
               Vec3(8.2, 0, 0));
}

}  // namespace hauberk::test
