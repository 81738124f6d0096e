#include "scenes.hpp"

namespace hauberk::test {

Rings::Rings(std::vector<Ring> rings) : rings_(std::move(rings))
{
  for (std::size_t k = 0; k < rings_.size(); ++k) {
    for (const char* n : {"R", "r0", "r1"}) {
      ParameterInfo i;
      i.name = "ring" + std::to_string(k) + "." + n;
      i.unit = "length";
      i.default_value = 1.0;
      i.lower = 1e-9;
      i.upper = 1e9;
      parameters_.push_back(i);
    }
  }
}

void Rings::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  for (std::size_t k = 0; k < rings_.size(); ++k) {
    Primitive q;
    q.name = "ring" + std::to_string(k);
    q.position = rings_[k].position;
    q.rotation = rings_[k].rotation;
    q.size = {p[3 * k], p[3 * k + 1], p[3 * k + 2]};
    q.kind = q.size[1] == q.size[2] ? PrimitiveKind::circle_tube : PrimitiveKind::revolved_ellipse;
    out.push_back(q);
  }
}

void Rings::do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const
{
  for (std::size_t k = 0; k < rings_.size(); ++k) {
    PrimitiveJacobian j(primitive_dofs * p.size(), 0.0);
    for (std::size_t i = 0; i < 3; ++i) j[(3 + i) * p.size() + 3 * k + i] = 1.0;
    out.push_back(j);
  }
}

const std::vector<MacroInfo>& Sheet::do_macros() const
{
  static const std::vector<MacroInfo> macros{{"exx", 0}, {"eyy", 0}, {"exy", 0}};
  return macros;
}

void Sheet::do_position(std::span<const double> m, std::span<const double> e, const Vec3& X, const Vec3& T,
                        PositionMap& out) const
{
  const Vec3 r = X + T;
  out.x = r + Vec3(m[0] * r.x() + m[2] * r.y() + e[0], m[2] * r.x() + m[1] * r.y() + e[1],
                   coordinates_ == 3 ? e[2] : 0.0);
  out.J.setZero();
  out.J(0, 0) = r.x();
  out.J(1, 1) = r.y();
  out.J(0, 2) = r.y();
  out.J(1, 2) = r.x();
  for (int k = 0; k < coordinates_; ++k) out.J(k, 3 + k) = 1.0;
  out.curved = false;
}

bool Sheet::do_admissible(std::span<const double> m) const { return do_stretch_range(m).first > 0.0; }

std::pair<double, double> Sheet::do_stretch_range(std::span<const double> m) const
{
  const double mean = 1.0 + 0.5 * (m[0] + m[1]), dev = std::hypot(0.5 * (m[0] - m[1]), m[2]);
  return {mean - dev, mean + dev};
}

void Sheet::do_load(double theta, std::span<double> t) const
{
  const double c = std::cos(theta), s = std::sin(theta);
  t[0] = c * c;
  t[1] = s * s;
  t[2] = 2.0 * c * s;
}

double Sheet::do_value(double theta, std::span<const double> m) const
{
  std::array<double, 3> t{};
  do_load(theta, t);
  return t[0] * m[0] + t[1] * m[1] + t[2] * m[2];
}

void Sheet::do_metric(std::span<double> m) const
{
  m[0] = m[1] = 1.0;
  m[2] = 2.0;
}

bool Sheet::do_transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const
{
  if (!keeps_plane(O)) return false;
  // F' = O F O^T.
  Eigen::Matrix2d eps;
  eps << macro[0], macro[2], macro[2], macro[1];
  const Eigen::Matrix2d O2 = O.topLeftCorner<2, 2>();
  const Eigen::Matrix2d turned = O2 * eps * O2.transpose();
  out[0] = turned(0, 0);
  out[1] = turned(1, 1);
  out[2] = 0.5 * (turned(0, 1) + turned(1, 0));
  return true;
}

SceneSpec chain(std::array<double, 3> first, std::array<double, 3> second, double period)
{
  SceneSpec s;
  s.types.push_back({"link", std::make_shared<Rings>()});
  const double quarter = 0.5 * std::numbers::pi;
  s.elements.push_back({0, {first[0], first[1], first[2]}, {Vec3::Zero(), Mat3::Identity()}});
  s.elements.push_back(
      {0, {second[0], second[1], second[2]}, {Vec3(0.5 * period, 0, 0), rotation_exp(Vec3(quarter, 0, 0))}});
  s.lattice = {Vec3(period, 0, 0), Vec3(0, 20.0 * period, 0)};
  return s;
}

SceneSpec chainmail(int m, int n, double tilt_degrees, double r1)
{
  SceneSpec s;
  s.types.push_back({"ring", std::make_shared<Rings>()});
  const Vec3 v1(12.2, 0, 0), v2(0, 6.0, 0);
  const double tilt = tilt_degrees * degree;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      const Vec3 shift = i * v1 + j * v2;
      s.elements.push_back({0, {4.9, 1.15, r1}, {shift, rotation_exp(Vec3(-tilt, 0, 0))}});
      s.elements.push_back({0, {4.9, 1.15, r1}, {shift + Vec3(6.1, 3.0, 0), rotation_exp(Vec3(tilt, 0, 0))}});
    }
  }
  s.lattice = {m * v1, n * v2};
  return s;
}

SceneSpec threefold_round()
{
  constexpr double centre = 4.25, side = 2.575, r = 0.95, a = threefold_spacing;
  std::vector<Rings::Ring> rings(1);
  std::vector<double> parameters{centre, r, r};
  for (const double azimuth : {-90.0, 30.0, 150.0}) {
    const Vec3 radial(std::cos(azimuth * degree), std::sin(azimuth * degree), 0.0);
    rings.push_back({(centre + side) * radial, rotation_from_z(Vec3(-radial.y(), radial.x(), 0.0))});
    parameters.insert(parameters.end(), {side, r, r});
  }
  SceneSpec s;
  s.types.push_back({"threefold", std::make_shared<Rings>(rings)});
  s.elements.push_back({0, parameters, {Vec3::Zero(), Mat3::Identity()}});
  s.lattice = {Vec3(a * std::cos(30.0 * degree), 0.5 * a, 0.0), Vec3(0.0, a, 0.0)};
  return s;
}

SceneSpec scaled_and_turned(const SceneSpec& scene, double factor, double angle)
{
  SceneSpec s = scene;
  const Mat3 Q = rotation_exp(Vec3(0.0, 0.0, angle));
  for (PlacedElement& e : s.elements) {
    for (double& p : e.parameters) p *= factor;
    e.rest = {factor * (Q * e.rest.position), Q * e.rest.rotation};
  }
  for (Vec3& t : s.lattice) t = factor * (Q * t);
  return s;
}

Mat3 random_rotation(std::mt19937_64& rng, double largest)
{
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> angle(0.0, largest);
  const Vec3 axis = Vec3(normal(rng), normal(rng), normal(rng)).normalized();
  return rotation_exp(angle(rng) * axis);
}

}  // namespace hauberk::test
