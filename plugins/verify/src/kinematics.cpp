#include "kinematics.hpp"

#include "neighbours.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>

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
  const std::size_t k = element;
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
  if (setting.places()) {
    out.own.setZero();
    return out;
  }
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
    Vec3 u = L * y.segment<3>(first_of(scene, static_cast<int>(k)));
    if (setting.places()) u.setZero();
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

HeldComponents held_components(const Scene& scene, const Setting& setting)
{
  const double theta = setting.direction_deg * std::numbers::pi / 180.0;
  const double c = std::cos(theta), s = std::sin(theta);
  HeldComponents out{{}, Matrix::Zero(macros(scene), 0)};
  const bool bent = setting.load == Load::paraboloid;
  for (const std::string& name : setting.hold) {
    if (bent && name == "places") continue;
    Vector row = Vector::Zero(macros(scene));
    const Eigen::Index last = row.size() - 1;
    // Of x^2, y^2 and x y, or of exx, eyy and exy, the last of all.
    if ((name == "shear" && !bent) || (name == "twist" && bent)) {
      row[0] = -c * s * (bent ? 2.0 : 1.0);
      row[1] = c * s * (bent ? 2.0 : 1.0);
      row[last] = c * c - s * s;
    } else if ((name == "lateral" && !bent) || (name == "transverse" && bent)) {
      row[0] = s * s * (bent ? 2.0 : 1.0);
      row[1] = c * c * (bent ? 2.0 : 1.0);
      row[last] = -2.0 * c * s;
    } else {
      throw Unknown("hold \"" + name + "\" is not known to this check");
    }
    out.names.push_back(name);
    out.coefficients.conservativeResize(Eigen::NoChange, out.coefficients.cols() + 1);
    out.coefficients.rightCols<1>() = row;
  }
  return out;
}

Matrix held(const Scene& scene, const Setting& setting)
{
  const Matrix components = held_components(scene, setting).coefficients;
  const bool gauged = setting.load == Load::paraboloid && !setting.places();
  Matrix rows = Matrix::Zero(unknowns(scene), components.cols() + (gauged ? 3 : 0));
  if (rows.cols() == 0) return rows;
  rows.topRightCorner(components.rows(), components.cols()) = components;
  for (std::size_t k = 0; gauged && k < scene.elements.size(); ++k) {
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

std::vector<std::string> misplaced(const Scene& scene, const Setting& setting, const MovedState& state,
                                   double tolerance)
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
  if (setting.places()) {
    for (std::size_t k = 0; k < state.places.size(); ++k) {
      const double away = (state.places[k].position - rest_of(scene, k).position).head<2>().norm();
      if (!(away <= allowed)) out.push_back(fmt::format("element {} is {:.3g} from its place", k, away));
    }
    if (!(off <= allowed)) out.push_back(fmt::format("an element is {:.3g} off the paraboloid", off));
    return out;
  }
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
