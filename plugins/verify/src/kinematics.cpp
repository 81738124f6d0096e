#include "kinematics.hpp"

#include "neighbours.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace hauberk::verification {
namespace {

double height_on(const Macro& macro, double x, double y)
{
  return macro.values[0] * x * x + macro.values[1] * y * y + macro.values[2] * x * y;
}

const Place& rest_of(const Scene& scene, std::size_t k) { return scene.elements[k].rest; }

}  // namespace

Eigen::Index unknowns(const Scene& scene)
{
  return macros(scene) + per_element * static_cast<Eigen::Index>(scene.elements.size());
}

Macros scaled(const Macro& macro, double length)
{
  return macro.load == Load::paraboloid ? Macros(macro.values * length) : macro.values;
}

PositionDerivatives derivatives(const Scene& scene, const Setting& setting, const MovedState& state,
                                int element, const Image& image)
{
  const auto k = static_cast<std::size_t>(element);
  PositionDerivatives out{Eigen::MatrixXd::Zero(3, macros(scene)), Mat3::Identity()};
  const Vec3 X = (rest_of(scene, k).position + translation(scene, Mat3::Identity(), image)) / scene.length;
  if (setting.load == Load::solid) {
    out.macro << X.x(), 0.0, 0.0, 0.0, X.z(), X.y(),  //
        0.0, X.y(), 0.0, X.z(), 0.0, X.x(),           //
        0.0, 0.0, X.z(), X.y(), X.x(), 0.0;
    return out;
  }
  if (setting.load == Load::strain) {
    out.macro << X.x(), 0.0, X.y(),  //
        0.0, X.y(), X.x(),           //
        0.0, 0.0, 0.0;
    if (setting.half_height == 0.0) out.own(2, 2) = 0.0;
    return out;
  }
  const Macros c = scaled(state.macro, scene.length);
  const double x = state.places[k].position.x() / scene.length;
  const double y = state.places[k].position.y() / scene.length;
  out.macro.row(2) << x * x, y * y, x * y;
  out.own.row(2) << 2.0 * c[0] * x + c[2] * y, 2.0 * c[1] * y + c[2] * x, 0.0;
  return out;
}

MovedState moved(const Scene& scene, const Setting& setting, const MovedState& state, const Vector& y)
{
  MovedState out = state;
  const double L = scene.length;
  out.macro.values += y.head(macros(scene)) / (setting.load == Load::paraboloid ? L : 1.0);
  const Mat3 change = out.macro.deformation() - state.macro.deformation();
  for (std::size_t k = 0; k < out.places.size(); ++k) {
    const Vec3 u = L * y.segment<3>(first_of(scene, static_cast<int>(k)));
    Vec3& x = out.places[k].position;
    if (setting.load != Load::paraboloid) {
      x += change * rest_of(scene, k).position + Vec3(u.x(), u.y(), setting.half_height == 0.0 ? 0.0 : u.z());
    } else {
      // What lies off the paraboloid stays off it by as much.
      const double off = x.z() - height_on(state.macro, x.x(), x.y());
      x.x() += u.x();
      x.y() += u.y();
      x.z() = off + height_on(out.macro, x.x(), x.y());
    }
    const Vec3 w = y.segment<3>(first_of(scene, static_cast<int>(k)) + 3);
    if (w.norm() > 0.0)
      out.places[k].rotation = Eigen::AngleAxisd(w.norm(), w.normalized()) * out.places[k].rotation;
  }
  return out;
}

Matrix held(const Scene& scene, const Setting& setting)
{
  Matrix rows = Matrix::Zero(unknowns(scene), 0);
  if (setting.load != Load::paraboloid) return rows;
  rows = Matrix::Zero(unknowns(scene), 3);
  for (std::size_t k = 0; k < scene.elements.size(); ++k) {
    const Vec3 X = rest_of(scene, k).position / scene.length;
    const Eigen::Index o = first_of(scene, static_cast<int>(k));
    rows(o, 0) = rows(o + 1, 1) = 1.0;
    rows(o, 2) = -X.y();
    rows(o + 1, 2) = X.x();
  }
  const Eigen::HouseholderQR<Matrix> qr(rows);
  return qr.householderQ() * Matrix::Identity(rows.rows(), rows.cols());
}

Vector free_part(const Matrix& held, const Vector& x)
{
  return held.cols() == 0 ? x : Vector(x - held * (held.transpose() * x));
}

std::vector<std::string> misplaced(const Scene& scene, const MovedState& state, double tolerance)
{
  std::vector<std::string> out;
  const auto n = static_cast<double>(state.places.size());
  Vec3 moved = Vec3::Zero(), fluctuation = Vec3::Zero();
  double off = 0.0, turn = 0.0;
  for (std::size_t k = 0; k < state.places.size(); ++k) {
    const Vec3 X = rest_of(scene, k).position, x = state.places[k].position;
    moved += (x - X) / n;
    fluctuation += (x - state.macro.deformation() * X) / n;
    if (state.macro.load == Load::paraboloid)
      off = std::max(off, std::abs(x.z() - X.z() - height_on(state.macro, x.x(), x.y())));
    turn += X.cross(x - X).z() / (n * scene.length);
  }
  const double allowed = tolerance * scene.length;
  if (state.macro.load != Load::paraboloid) {
    // Either the mean position or the mean of u = x - F X may be the one that is held.
    const double mean = std::min(moved.norm(), fluctuation.norm());
    if (!(mean <= allowed)) out.push_back(fmt::format("the mean translation moved by {:.3g}", mean));
    return out;
  }
  if (!(moved.head<2>().norm() <= allowed))
    out.push_back(fmt::format("the mean of the patch moved by {:.3g} from the apex", moved.head<2>().norm()));
  if (!(std::abs(turn) <= allowed))
    out.push_back(fmt::format("the patch turned: the mean of X x (x - X) is {:.3g} L", turn));
  if (!(off <= allowed)) out.push_back(fmt::format("an element is {:.3g} off the paraboloid", off));
  return out;
}

}  // namespace hauberk::verification
