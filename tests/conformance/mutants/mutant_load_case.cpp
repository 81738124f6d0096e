/// A load case with curvature, walls and a length of its own, and with a defect.
///
/// Unknowns e and g: x = F (X + T) + u, F = [[a, g], [g, a]] in the plane, a = exp e, and u in space within a
/// layer around the plane. Admissible is |g| < 1 + e, a convex part of where F is positive definite.
/// `weighted` doubles the metric.

#include "defect.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hauberk::mutants {
namespace {

class Mutant final : public LoadCase {
 public:
  Mutant(std::string defect, double half_height, bool weighted)
      : defect_(std::move(defect)), half_height_(half_height), weighted_(weighted)
  {
    if (is("macro_length_power")) macros_[e].length_power = -1;
    if (is("same_unknown_twice")) macros_[g].name = "e";
  }

 protected:
  using Values = std::span<const double>;

  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return 3; }
  int do_lattice_vectors() const override { return 2; }

  void do_position(Values macro, Values u, const Vec3& X, const Vec3& T, PositionMap& out) const override
  {
    const Vec3 rest = X + T;
    const double a = stretch(macro[e]), slope = a;
    out.x = Vec3(a * rest.x() + macro[g] * rest.y(), macro[g] * rest.x() + a * rest.y(), rest.z()) +
            Vec3(u[0], u[1], u[2]);
    out.J.col(e) = slope * Vec3(rest.x(), rest.y(), 0.0);
    out.J.col(g) = Vec3(rest.y(), rest.x(), 0.0);
    out.J.block<3, 3>(0, 2).setIdentity();
    for (auto& component : out.H) {
      for (auto& row : component) row.fill(0.0);
    }
    out.H[0][e][e] = a * rest.x();
    out.H[1][e][e] = a * rest.y();
    out.curved = true;
    spoil(macro, u, rest, T, out);
  }

  double do_acceleration_bound(Values macro, Values dmacro, Values, Values, const Vec3& X,
                               const Vec3& T) const override
  {
    const Vec3 rest = X + T;
    const double start = stretch(macro[e]), end = stretch(macro[e] + dmacro[e]);
    const double bound = dmacro[e] * dmacro[e] * std::hypot(rest.x(), rest.y()) * std::max(start, end);
    if (is("bound_of_the_start")) return bound * start / std::max(start, end);
    if (is("bound_of_the_mean")) return bound * 0.5 * (start + end) / std::max(start, end);
    if (is("half_acceleration_bound")) return 0.5 * bound;
    if (is("acceleration_bound_of_the_element"))
      return dmacro[e] * dmacro[e] * std::hypot(X.x(), X.y()) * std::max(start, end);
    return is("low_acceleration_bound") ? 0.9 * bound : bound;
  }

  bool do_admissible(Values macro) const override
  {
    if (is("hole_in_admissible") && std::hypot(macro[e] - 0.5, macro[g]) < 0.3) return false;
    if (is("admits_not_a_number") && !(macro[g] == macro[g])) return true;
    if (is("rest_not_admissible") && macro[e] == 0.0) return false;
    return std::abs(macro[g]) < 1.0 + macro[e];
  }
  std::pair<double, double> do_stretch_range(Values macro) const override
  {
    const double a = stretch(macro[e]), g_size = std::abs(macro[g]);
    if (is("stretch_range_times_0.9")) return {a - g_size, 0.9 * (a + g_size)};
    if (is("stretch_range_times_0.999")) return {a - g_size, 0.999 * (a + g_size)};
    if (is("stretch_range_from_above")) return {1.001 * (a - g_size), a + g_size};
    if (is("stretch_range_of_the_axes")) return {std::hypot(a, g_size), std::hypot(a, g_size)};
    if (is("narrow_stretch_range")) return {a - 0.5 * g_size, a + g_size};
    return {a - g_size, a + g_size};
  }

  void do_load(double theta, std::span<double> t) const override
  {
    t[e] = 1.0;
    t[g] = std::sin(2.0 * theta);
    if (is("load_of_other_angle")) t[g] = std::cos(2.0 * theta);
    if (is("load_has_the_wrong_sign")) t[g] *= -1.0;
    if (is("load_behind_option") && weighted_) t[g] *= 1.0 + 1e-6;
    if (is("load_nearly_dual")) t[g] *= 1.0 + 1e-6;
  }
  double do_value(double theta, Values macro) const override
  {
    const double offset = is("value_not_zero_at_rest") ? 0.1 : 0.0;
    if (value_disturbs()) disturb(defect_.substr(6));
    if (is("value_in_percent")) return 100.0 * (macro[e] + std::sin(2.0 * theta) * macro[g]);
    return macro[e] + std::sin(2.0 * theta) * macro[g] + offset;
  }
  std::string do_measure() const override { return is("no_measure") ? "" : "mixed"; }
  int do_value_length_power() const override { return is("value_length_power") ? -1 : 0; }
  std::pair<std::string, std::string> do_sense_names() const override { return {"stretch", "compress"}; }
  void do_metric(std::span<double> m) const override
  {
    if (is("rounds_down")) std::fesetround(FE_TOWARDZERO);
    m[e] = weighted_ ? 4.0 : 2.0;
    m[g] = is("zero_metric") ? 0.0 : m[e];
    if (is("metric_behind_option") && weighted_) m[g] = -m[g];
  }

  /// Whatever maps the axes to each other keeps F what it is; a single mirror turns the shear round.
  bool do_transform(const Mat3& O, Values macro, std::span<double> out) const override
  {
    const double whole = O(0, 0) * O(1, 1) + O(0, 1) * O(1, 0);
    const bool axes = keeps_plane(O) && std::abs(std::abs(whole) - 1.0) < 1e-9;
    if (!axes && !is("turns_by_any_angle")) return false;
    out[e] = macro[e];
    out[g] = is("mirrors_no_shear") ? macro[g] : whole * macro[g];
    if (is("transform_not_linear")) out[g] += out[g] * out[g];
    if (is("transform_stretches")) out[e] *= 1.5;
    return true;
  }
  std::vector<StricterLoadCase> do_stricter() const override
  {
    std::string defect = is("stricter_has_another_value") ? "value_not_zero_at_rest" : defect_;
    if (is("stricter_keeps_another_mean")) defect = "keeps_another_mean";
    const double height = (is("stricter_is_higher") ? 2.0 : 0.5) * half_height_;
    std::vector<StricterLoadCase> out;
    out.push_back({"lower", std::make_unique<Mutant>(defect, height, weighted_)});
    return out;
  }
  bool do_contains(const LoadCase& other) const override
  {
    const auto* mutant = dynamic_cast<const Mutant*>(&other);
    if (mutant == nullptr || is("contains_nothing")) return false;
    if (is("stricter_is_higher")) return mutant->half_height_ >= half_height_;
    return mutant->half_height_ <= half_height_;
  }
  std::vector<LinearInequality> do_inequalities(std::span<const Vec3> X) const override
  {
    std::vector<LinearInequality> walls;
    for (int i = 0; i < static_cast<int>(X.size()); ++i) {
      for (const double side : {1.0, -1.0})
        walls.push_back({side > 0.0 ? "upper" : "lower", {{i, 2, -side}}, half_height_});
    }
    if (is("wall_violated_at_rest")) walls.back().offset = -0.01;
    if (is("wall_of_nobody")) walls.back().terms[0].element = static_cast<int>(X.size());
    return walls;
  }
  std::vector<LinearEquality> do_equalities(std::span<const Vec3> X) const override
  {
    std::vector<LinearEquality> held{{"mean x", {}}, {"mean y", {}}};
    for (int i = 0; i < static_cast<int>(X.size()); ++i) {
      for (int k = 0; k < 2; ++k) held[k].terms.push_back({i, k, 1.0});
    }
    if (is("keeps_another_mean")) held.front().terms.front().coefficient = 2.0;
    if (is("condition_twice")) held.push_back(held.front());
    return held;
  }

  Boundedness do_boundedness(Values load, std::span<const Vec3> cycles) const override
  {
    if (is("boundedness_throws") && cycles.empty()) throw std::runtime_error("no cycles");
    const auto holds = [](const Vec3& T) { return T.norm() > 1e-9; };
    if (is("bounded_by_first_cycle")) cycles = cycles.first(std::min<std::size_t>(cycles.size(), 1));
    if (is("bounded_by_load_size") && std::abs(load[e]) > 2.0) return Boundedness::attained;
    return std::any_of(cycles.begin(), cycles.end(), holds) ? Boundedness::attained : Boundedness::unbounded;
  }

 private:
  enum { e, g };
  bool is(const char* defect) const { return defect_ == defect; }
  bool value_disturbs() const { return defect_.rfind("value_", 0) == 0; }
  static double stretch(double strain) { return std::exp(strain); }

  void spoil(Values macro, Values u, const Vec3& rest, const Vec3& T, PositionMap& out) const
  {
    out.x.z() += whim(defect_, this, macro[e]);
    if (is("slow")) wait(1e-3);
    if (is("sign_behind_option") && weighted_) out.J(1, g) *= -1.0;
    if (is("nearly_right_behind_option") && weighted_) out.J(0, g) *= 1.0 + 1e-6;
    if (is("second_derivative_far") && std::abs(macro[g]) > 0.2) out.H[0][e][e] *= 1.001;
    if (is("throws_far") && std::abs(macro[g]) > 0.25) throw std::out_of_range("vector::at");
    if (is("not_a_number_far") && std::abs(macro[g]) > 0.25) out.x.y() = std::sqrt(-1.0);
    if (is("single_precision")) out.x.x() = static_cast<float>(out.x.x());
    if (is("static_scratch")) {
      static double scratch = 0.0;
      scratch = rest.x();
      wait(2e-6);  // what else is computed meanwhile
      out.x.x() += 1e-3 * (static_cast<volatile double&>(scratch) - rest.x());
    }
    if (is("image_drifts")) out.x.z() += 1e-6 * T.x();
    if (is("moved_at_rest")) out.x.x() += 1e-6;
    if (is("wrong_first_derivative")) out.J(1, g) = rest.y();
    if (is("nearly_right_first_derivative")) out.J(0, e) *= 1.0 + 1e-6;
    if (is("wrong_second_derivative")) out.H[1][e][e] *= 0.5;
    if (is("says_it_is_flat")) out.curved = false;
    if (is("column_of_nobody")) out.J(2, 7) = 1.0;
    if (is("image_turns_with_element")) {  // its derivatives are right
      out.x += 0.01 * u[0] * T;
      out.J.col(2) += 0.01 * T;
    }
    if (is("image_of_image_elsewhere")) {
      out.x.z() += 0.01 * T.x() * T.x() * macro[g];
      out.J(2, g) += 0.01 * T.x() * T.x();
    }
  }

  std::vector<MacroInfo> macros_{{"e", 0}, {"g", 0}};
  std::string defect_;
  double half_height_;
  bool weighted_;
};

void fields(std::vector<Field>& out)
{
  Field height;
  height.name = "half_height";
  height.unit = "length";
  height.doc = "Half-height of the layer.";
  height.minimum = 0.0;
  height.default_json = "1";
  out.push_back(height);
  Field weighted;
  weighted.name = "weighted";
  weighted.kind = Field::Kind::boolean;
  weighted.doc = "Whether the metric is doubled.";
  weighted.default_json = "false";
  out.push_back(weighted);
  add_defect_field(out);
}

std::unique_ptr<LoadCase> make(const Node& section, double length, Problems&)
{
  const std::string defect = defect_of(section);
  const double height = section.at("half_height").number;
  if (defect == "make_prints") disturb("prints");
  return std::make_unique<Mutant>(defect, defect == "forgets_the_length" ? height : height / length,
                                  section.at("weighted").boolean);
}

}  // namespace
}  // namespace hauberk::mutants

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::load_case,
    "mutant_load_case",
    "1.0",
    "A load case with a defect.",
    "none",
    hauberk::mutants::fields,
    nullptr,
    hauberk::mutants::make,
    nullptr};
