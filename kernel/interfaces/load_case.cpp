#include "numerics/decompositions.hpp"

#include <hauberk/error.hpp>
#include <hauberk/load_case.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace hauberk {
namespace {

/// Dimensions of a lattice's own space: x and y of a sheet, all three of a solid.
int dimensions(const LoadCase& load) { return std::min(load.lattice_vectors(), 3); }

PositionMap image_of_origin(const LoadCase& load, std::span<const double> macro, const Vec3& T)
{
  const std::array<double, max_coordinates> none{};
  PositionMap out;
  load.position(macro, {none.data(), static_cast<std::size_t>(load.coordinate_count())}, Vec3::Zero(), T,
                out);
  return out;
}

/// F, the map of lattice translations, columns for the lattice's dimensions.
Eigen::Matrix3Xd translation_map(const LoadCase& load, std::span<const double> macro)
{
  const Vec3 origin = image_of_origin(load, macro, Vec3::Zero()).x;
  Eigen::Matrix3Xd F(3, dimensions(load));
  for (int k = 0; k < F.cols(); ++k) F.col(k) = image_of_origin(load, macro, Vec3::Unit(k)).x - origin;
  return F;
}

}  // namespace

double LoadCase::do_value(double theta, std::span<const double> macro) const
{
  std::array<double, max_macro> t{};
  do_load(theta, {t.data(), macro.size()});
  return std::inner_product(macro.begin(), macro.end(), t.begin(), 0.0);
}

int LoadCase::do_value_length_power() const
{
  const int power = macros().empty() ? 0 : macros().front().length_power;
  for (const MacroInfo& m : macros()) {
    if (m.length_power != power)
      throw PluginError(
          "load case: its unknowns have several units, so it has to say which one its value has");
  }
  return power;
}

void LoadCase::do_metric(std::span<double> m) const
{
  std::fill(m.begin(), m.end(), periodic() ? 0.0 : 1.0);
  const std::array<double, max_macro> rest{};
  const std::span<const double> macro{rest.data(), m.size()};
  const PositionMap origin = image_of_origin(*this, macro, Vec3::Zero());
  for (int k = 0; k < dimensions(*this); ++k) {
    const PositionMap image = image_of_origin(*this, macro, Vec3::Unit(k));
    for (std::size_t c = 0; c < m.size(); ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      m[c] += (image.J.col(column) - origin.J.col(column)).squaredNorm();
    }
  }
}

bool LoadCase::do_admissible(std::span<const double> macro) const
{
  if (!std::all_of(macro.begin(), macro.end(), [](double x) { return std::isfinite(x); })) return false;
  if (!periodic()) return true;
  const Eigen::MatrixXd F = translation_map(*this, macro).topRows(dimensions(*this));
  const Eigen::MatrixXd symmetric = 0.5 * (F + F.transpose());
  return symmetric_eigenvalues(symmetric).minCoeff() > 0.0;
}

std::pair<double, double> LoadCase::do_stretch_range(std::span<const double> macro) const
{
  if (!periodic()) return {1.0, 1.0};
  const Eigen::VectorXd values = singular_values(translation_map(*this, macro));
  return {values.minCoeff(), values.maxCoeff()};
}

void LoadCase::position(std::span<const double> macro, std::span<const double> e, const Vec3& X,
                        const Vec3& T, PositionMap& out) const
{
  // This call is in the innermost loops, so the checks are comparisons of sizes and one sum.
  const std::size_t macros = macro_count();
  const std::size_t coordinates = coordinate_count();
  if (macros > max_macro || coordinates > max_coordinates) {
    throw PluginError(
        fmt::format("load case: declares {} macroscopic unknowns (at most {}) and {} coordinates of "
                    "an element (at most {})",
                    macros, max_macro, coordinates, max_coordinates));
  }
  if (macro.size() != macros || e.size() != coordinates) {
    throw PluginError(
        fmt::format("load case: expected {} macroscopic unknowns and {} coordinates, found {} and {}", macros,
                    coordinates, macro.size(), e.size()));
  }
  // H is large and only read when curved: whoever sets `curved` fills it.
  out.x.setZero();
  out.J.setZero();
  out.curved = false;
  do_position(macro, e, X, T, out);
  if (!out.x.allFinite() || !out.J.allFinite()) {
    throw PluginError("load case: the position of an element or its derivative is not finite");
  }
}

void LoadCase::load(const Direction& direction, std::span<double> t) const
{
  if (direction.is_angle()) return do_load(direction.theta(), t);
  const std::span<const double> d = direction.components();
  if (d.size() != t.size() || t.size() != static_cast<std::size_t>(macro_count())) {
    throw PluginError(
        fmt::format("load case: expected a direction of {} components, found {}", macro_count(), d.size()));
  }
  std::array<double, max_macro> metric{};
  do_metric({metric.data(), d.size()});
  // Scaled by the largest component, so that no square over- or underflows.
  double largest = 0.0, norm = 0.0;
  for (const double x : d) largest = std::max(largest, std::abs(x));
  for (std::size_t k = 0; k < d.size(); ++k) norm += metric[k] * (d[k] / largest) * (d[k] / largest);
  norm = std::sqrt(norm);
  if (!std::isfinite(norm) || !(norm > 0.0))
    throw PluginError("load case: the metric gives the direction " + direction.text() + " no length");
  for (std::size_t k = 0; k < d.size(); ++k) t[k] = metric[k] * (d[k] / largest) / norm;
}

double LoadCase::value(const Direction& direction, std::span<const double> macro) const
{
  if (direction.is_angle()) return do_value(direction.theta(), macro);
  std::array<double, max_macro> t{};
  load(direction, {t.data(), macro.size()});
  return std::inner_product(macro.begin(), macro.end(), t.begin(), 0.0);
}

bool LoadCase::transform(const Mat3& O, std::span<const double> macro, std::span<double> out) const
{
  const std::size_t macros = macro_count();
  if (macro.size() != macros || out.size() != macros) {
    throw PluginError(fmt::format("load case: expected {} macroscopic unknowns, found {} and {}", macros,
                                  macro.size(), out.size()));
  }
  if (O == Mat3::Identity()) {
    std::copy(macro.begin(), macro.end(), out.begin());
    return true;
  }
  if (!do_transform(O, macro, out)) return false;
  if (!std::all_of(out.begin(), out.end(), [](double x) { return std::isfinite(x); }))
    throw PluginError("load case: a transformed macroscopic unknown is not finite");
  return true;
}

std::vector<std::pair<std::string, double>> LoadCase::companions(const Direction& direction,
                                                                 std::span<const double> macro) const
{
  return direction.is_angle() ? do_companions(direction.theta(), macro)
                              : std::vector<std::pair<std::string, double>>{};
}

std::string LoadCase::sense_name(const Direction& direction, Sense sense) const
{
  if (!direction.is_angle()) return sense == Sense::positive ? "along" : "against";
  const auto names = sense_names();
  return sense == Sense::positive ? names.first : names.second;
}

bool LoadCase::takes_components() const
{
  const std::vector<MacroInfo>& unknowns = macros();
  return std::all_of(unknowns.begin(), unknowns.end(),
                     [power = value_length_power()](const MacroInfo& m) { return m.length_power == power; });
}

Boundedness LoadCase::boundedness(const Direction& direction, Sense sense, std::span<const Vec3> cycles) const
{
  std::array<double, max_macro> t{};
  const std::span<double> pull{t.data(), static_cast<std::size_t>(macro_count())};
  load(direction, pull);
  if (sense == Sense::negative) {
    for (double& x : pull) x = -x;
  }
  return direction.is_angle() && !do_conditions(direction.theta()).empty()
             ? do_held_boundedness(direction.theta(), pull, cycles)
             : do_boundedness(pull, cycles);
}

std::vector<std::string> LoadCase::hold(const Direction& direction) const
{
  std::vector<std::string> out = do_hold();
  if (direction.is_angle()) return out;
  for (const MacroCondition& c : do_conditions(0.0)) std::erase(out, c.name);
  return out;
}

std::vector<MacroCondition> LoadCase::conditions(const Direction& direction) const
{
  if (!direction.is_angle()) return {};
  std::vector<MacroCondition> out = do_conditions(direction.theta());
  for (const MacroCondition& c : out) {
    double squares = 0.0;
    for (int k = 0; k < macro_count(); ++k) {
      const double x = c.coefficients[k];
      squares += x * x;
    }
    if (!(squares > 0.0) || !std::isfinite(squares))
      throw PluginError("load case: the condition '" + c.name + "' at " + direction.text() +
                        " has no finite coefficients, or none that is not zero");
  }
  return out;
}

}  // namespace hauberk
