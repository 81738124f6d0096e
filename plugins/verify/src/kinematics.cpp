#include "kinematics.hpp"

#include "neighbours.hpp"
#include "roll.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hauberk::verification {
namespace {

/// What is smaller beside the others depends on them.
constexpr double dependent = 1e-9;

double height_on(const Macro& macro, double x, double y)
{
  return macro.values[0] * x * x + macro.values[1] * y * y + macro.values[2] * x * y;
}

const Place& rest_of(const Scene& scene, std::size_t k) { return scene.elements[k].rest; }

/// K of a strip, which bends about x, times L.
Macros strip_curvature(const Macro& macro, double length) { return Vec3(0.0, macro.values[1] * length, 0.0); }

/// Where an element of a strip is on the flat sheet, over L: how far it left its place along the axis, its
/// place around it and its height.
Vec3 flat_place_on_strip(const Scene& scene, const MovedState& state, std::size_t k)
{
  const Vec3 x = state.places[k].position / scene.length, X = rest_of(scene, k).position / scene.length;
  const Vec3 around =
      unrolled(strip_curvature(state.macro, scene.length), {0.0, x.y(), x.z()}, {0.0, X.y(), X.z()});
  return {x.x() - (1.0 + state.macro.values[0]) * X.x(), around.y(), around.z()};
}

/// Where an element of a roll is on the flat sheet, over L.
Vec3 flat_place(const Scene& scene, const MovedState& state, std::size_t k)
{
  if (state.macro.load == Load::strip) return flat_place_on_strip(scene, state, k);
  return unrolled(scaled(state.macro, scene.length), state.places[k].position / scene.length,
                  rest_of(scene, k).position / scene.length);
}

/// Where that place goes under other unknowns.
Vec3 placed_on_strip(const Macro& macro, double length, const Vec3& X, const Vec3& flat)
{
  Vec3 out = rolled(strip_curvature(macro, length), {0.0, flat.y(), flat.z()});
  out.x() = (1.0 + macro.values[0]) * X.x() + flat.x();
  return out;
}

PositionDerivatives strip_derivatives(const Scene& scene, const Setting& setting, const MovedState& state,
                                      std::size_t k, const Vec3& X)
{
  const Vec3 flat = flat_place(scene, state, k);
  const Eigen::Matrix<double, 3, 6> all =
      rolled_derivatives(strip_curvature(state.macro, scene.length), {0.0, flat.y(), flat.z()});
  PositionDerivatives out{Eigen::MatrixXd::Zero(3, 2), Mat3::Identity()};
  out.macro(0, 0) = X.x();
  out.macro.col(1) = all.col(1);
  out.own.rightCols<2>() = all.rightCols<2>();
  if (setting.places()) out.own.leftCols<2>().setZero();
  if (setting.half_height == 0.0) out.own.col(2).setZero();
  return out;
}

PositionDerivatives roll_derivatives(const Scene& scene, const Setting& setting, const MovedState& state,
                                     std::size_t k)
{
  const Eigen::Matrix<double, 3, 6> all =
      rolled_derivatives(scaled(state.macro, scene.length), flat_place(scene, state, k));
  PositionDerivatives out{all.leftCols<3>(), all.rightCols<3>()};
  if (setting.places()) out.own.leftCols<2>().setZero();
  if (setting.half_height == 0.0) out.own.col(2).setZero();
  return out;
}

/// Rows of what holds a patch where it is: its mean and its turn about z, and where elements may leave a roll
/// what fits the roll to them. They may depend on each other.
Matrix gauge_rows(const Scene& scene, const Setting& setting)
{
  const bool slides = !setting.places();
  if (setting.load == Load::strip) {
    const bool free = setting.half_height > 0.0;
    Matrix rows = Matrix::Zero(unknowns(scene), (slides ? 2 : 0) + (free ? 3 : 0));
    for (std::size_t k = 0; k < scene.elements.size(); ++k) {
      const double Y = rest_of(scene, k).position.y() / scene.length;
      const Eigen::Index o = first_of(scene, static_cast<int>(k));
      if (slides) rows.block<2, 2>(o, 0).setIdentity();
      if (free) rows.row(o + 2).tail<3>() << 1.0, Y, Y * Y;
    }
    return rows;
  }
  const bool lifts = setting.load == Load::roll && setting.half_height > 0.0;
  Matrix rows = Matrix::Zero(unknowns(scene), (slides ? 3 : 0) + (lifts ? 6 : 0));
  for (std::size_t k = 0; k < scene.elements.size(); ++k) {
    const Vec3 X = rest_of(scene, k).position / scene.length;
    const Eigen::Index o = first_of(scene, static_cast<int>(k));
    if (slides) rows.block<2, 3>(o, 0) << 1.0, 0.0, -X.y(), 0.0, 1.0, X.x();
    if (lifts) rows.row(o + 2).tail<6>() << 1.0, X.x(), X.y(), X.x() * X.x(), X.y() * X.y(), X.x() * X.y();
  }
  return rows;
}

/// The same for a state: elements off the roll, and parts of its motion along what is held.
std::vector<std::string> misplaced_on_roll(const Scene& scene, const Setting& setting,
                                           const MovedState& state, double tolerance)
{
  std::vector<std::string> out;
  const bool strip = setting.load == Load::strip;
  const Macros K = scaled(state.macro, scene.length);
  Vector motion = Vector::Zero(unknowns(scene));
  for (std::size_t k = 0; k < state.places.size(); ++k) {
    Vec3 at = flat_place(scene, state, k), X = rest_of(scene, k).position / scene.length;
    const Vec3 there = strip ? placed_on_strip(state.macro, scene.length, X, at) : rolled(K, at);
    const double missed = (there - state.places[k].position / scene.length).norm();
    if (strip) X.x() = 0.0;  // as `at` has it
    if (!(missed <= tolerance)) out.push_back(fmt::format("element {} is nowhere about the roll", k));
    if (setting.half_height == 0.0 && !(std::abs(at.z() - X.z()) <= tolerance))
      out.push_back(
          fmt::format("element {} is {:.3g} off the roll", k, scene.length * std::abs(at.z() - X.z())));
    if (setting.places() && !((at - X).head<2>().norm() <= tolerance))
      out.push_back(
          fmt::format("element {} is {:.3g} from its place", k, scene.length * (at - X).head<2>().norm()));
    motion.segment<3>(first_of(scene, static_cast<int>(k))) = at - X;
  }
  const Matrix rows = gauge_rows(scene, setting);
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    const double part = rows.col(k).dot(motion) / std::max(1.0, rows.col(k).lpNorm<1>());
    if (!(std::abs(part) <= tolerance))
      out.push_back(
          fmt::format("the patch moved against its roll: moment {} of the motion is {:.3g} L", k, part));
  }
  return out;
}

}  // namespace

Eigen::Index unknowns(const Scene& scene)
{
  return macros(scene) + per_element * static_cast<Eigen::Index>(scene.elements.size());
}

Macros scaled(const Macro& macro, double length)
{
  if (macro.load == Load::strip) return Eigen::Vector2d(macro.values[0], macro.values[1] * length);
  return is_bent(macro.load) ? Macros(macro.values * length) : macro.values;
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
  if (setting.load == Load::strip) return strip_derivatives(scene, setting, state, k, X);
  if (setting.load == Load::roll) return roll_derivatives(scene, setting, state, k);
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
  Vector change_of_macro = y.head(macros(scene));
  if (is_bent(setting.load)) change_of_macro.tail(setting.load == Load::strip ? 1 : 3) /= L;
  out.macro.values += change_of_macro;
  const Mat3 change = out.macro.deformation() - state.macro.deformation();
  for (std::size_t k = 0; k < out.places.size(); ++k) {
    Vec3 u = L * y.segment<3>(first_of(scene, static_cast<int>(k)));
    if (setting.places()) u.head<2>().setZero();
    Vec3& x = out.places[k].position;
    if (setting.load == Load::roll) {
      if (setting.half_height == 0.0) u.z() = 0.0;
      x = L * rolled(scaled(out.macro, L), flat_place(scene, state, k) + u / L);
    } else if (setting.load == Load::strip) {
      if (setting.half_height == 0.0) u.z() = 0.0;
      x = L *
          placed_on_strip(out.macro, L, rest_of(scene, k).position / L, flat_place(scene, state, k) + u / L);
    } else if (setting.load != Load::paraboloid) {
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
  const bool bent = is_bent(setting.load);
  const double diagonal = setting.load == Load::paraboloid ? 2.0 : 1.0;
  for (const std::string& name : setting.hold) {
    if (bent && name == "places") continue;
    Vector row = Vector::Zero(macros(scene));
    const Eigen::Index last = row.size() - 1;
    // Of x^2, y^2 and x y, or of exx, eyy and exy, the last of all.
    if ((name == "shear" && !bent) || (name == "twist" && bent)) {
      row[0] = -c * s * diagonal;
      row[1] = c * s * diagonal;
      row[last] = c * c - s * s;
    } else if ((name == "lateral" && !bent) || (name == "transverse" && bent)) {
      row[0] = s * s * diagonal;
      row[1] = c * c * diagonal;
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
  const Matrix gauge = is_bent(setting.load) ? gauge_rows(scene, setting) : Matrix(unknowns(scene), 0);
  Matrix rows = Matrix::Zero(unknowns(scene), gauge.cols() + components.cols());
  if (rows.cols() == 0) return rows;
  rows.leftCols(gauge.cols()) = gauge;
  rows.topRightCorner(components.rows(), components.cols()) = components;
  Eigen::ColPivHouseholderQR<Matrix> qr(rows);
  qr.setThreshold(dependent);
  return qr.householderQ() * Matrix::Identity(rows.rows(), qr.rank());
}

Vector free_part(const Matrix& held, const Vector& x)
{
  return held.cols() == 0 ? x : Vector(x - held * (held.transpose() * x));
}

std::vector<std::string> misplaced(const Scene& scene, const Setting& setting, const MovedState& state,
                                   double tolerance)
{
  if (setting.load == Load::roll || setting.load == Load::strip)
    return misplaced_on_roll(scene, setting, state, tolerance);
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
