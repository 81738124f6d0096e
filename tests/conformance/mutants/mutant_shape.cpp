/// The template's shape with a defect.

#include "defect.hpp"

#include <hauberk/error.hpp>

#include <chrono>
#include <thread>

#define hauberk_plugin reference_plugin
#include "../../../plugins/template/shape/plugin_name.cpp"  // NOLINT(bugprone-suspicious-include)
#undef hauberk_plugin

namespace hauberk::mutants {
namespace {

// Wrong on purpose: what instances share.
double shared_size = 0.0;
int shared_calls = 0;

class Mutant final : public Shape {
 public:
  Mutant(std::unique_ptr<Shape> inner, std::string defect, bool crossed)
      : inner_(std::move(inner)),
        defect_(std::move(defect)),
        crossed_(crossed),
        parameters_(inner_->parameters())
  {
    if (is("default_outside_bounds")) parameters_[waist].default_value = 3.0;
    if (is("same_name_twice")) parameters_[r].name = "R";
    if (is("no_unit")) parameters_[waist].unit = "furlong";
    if (is("shared_state")) shared_size = crossed ? 0.5 : 0.25;
    if (is("unit_of_r")) parameters_[r].unit = "1";
    if (is("unit_of_waist")) parameters_[waist].unit = "length";
    if (is("bounds_the_wrong_way")) std::swap(parameters_[waist].lower, parameters_[waist].upper);
    if (is("parameter_without_name")) parameters_[r].name.clear();
  }

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }

  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    if (is("throws")) throw std::runtime_error("no primitives today");
    if (is("throws_far_away") && p[waist] > 1.7) throw std::runtime_error("not as far as that");
    if (is("rounds_up")) std::fesetround(FE_UPWARD);
    if (is("closed_hole") && p[r] >= p[R]) {
      out = inner_->primitives(std::vector<double>{p[r] * 2.0, p[r], p[waist]});
      for (Primitive& ring : out) ring.size[0] = p[R];
      return;
    }
    if (is("unnamed_refusal") && p[r] >= p[R]) throw InputError("it does not work like that");
    out = inner_->primitives(p);
    Primitive& right = out.back();
    if (is("name_changes") && p[waist] > 1.5) right.name = "far";
    if (is("order_changes") && p[waist] > 1.5) std::swap(out.front(), out.back());
    if (is("number_changes") && p[waist] > 1.5) out.pop_back();
    if (is("not_a_number")) right.position.y() = std::nan("");
    if (is("hidden_length")) right.position.y() += 0.1;
    if (is("turns") || turns_with_rows())
      right.rotation = rotation_exp(Vec3(0.0, 0.0, p[waist] - 1.5)) * right.rotation;
    if (is("kink")) right.position.y() += 0.1 * p[R] * std::abs(p[waist] - 1.5);
    if (is("jump") && p[waist] > 1.5) right.position.y() += 1e-3 * p[R];
    if (is("meets_itself")) {  // a figure of eight whose loops cross in the middle
      right.kind = PrimitiveKind::curve_tube;
      right.curve = {{Vec3(p[R], 0.0, 0.0), Vec3::Zero()}, {Vec3::Zero(), Vec3(0.0, 0.35 * p[R], 0.0)}};
    }
    spoil(p, right);
    if (is("shared_state")) right.position.y() += shared_size * p[R];
    if (is("counts_calls")) right.position.y() += 1e-12 * p[R] * ++shared_calls;
    if (is("not_thread_safe")) {
      scratch_ = p[R];
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      right.position.y() += scratch_;
    }
  }

  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override
  {
    out = inner_->jacobians(p);
    double& x_waist = out.back()[0 * 3 + waist];
    double& y_R = out.back()[1 * 3 + R];
    double& y_waist = out.back()[1 * 3 + waist];
    if (is("wrong_derivative")) x_waist *= -1.0;
    if (is("nearly_right_derivative")) x_waist *= 1.0 + 1e-6;
    if (is("forgotten_column")) out.back()[5 * 3 + r] = 0.0;
    if (is("transposed")) std::swap(out.back()[0 * 3 + waist], out.back()[2 * 3 + R]);
    if (turns_with_rows()) {
      double& z_waist = out.back()[8 * 3 + waist];
      z_waist = is("turns_the_other_way") ? -1.0 : is("turns_in_degrees") ? 1.0 / degree : 1.0;
    }
    if (is("too_few_rows")) out.back().resize(9);
    if (is("kink")) {
      y_R += 0.1 * std::abs(p[waist] - 1.5);
      y_waist += p[waist] > 1.5 ? 0.1 * p[R] : -0.1 * p[R];
    }
    if (is("jump") && p[waist] > 1.5) y_R += 1e-3;
    spoil(p, out.back());
    if (is("shared_state")) y_R += shared_size;
    if (is("not_thread_safe")) y_R += 1.0;
  }

 private:
  enum { R, r, waist };
  bool is(const char* defect) const { return defect_ == defect; }
  /// No defect by itself: `turns_as_it_says` is right.
  bool turns_with_rows() const
  {
    return is("turns_as_it_says") || is("turns_the_other_way") || is("turns_in_degrees");
  }
  bool is_far(std::span<const double> p) const { return p[R] > 20.0; }
  bool is_corner(std::span<const double> p) const
  {
    const auto& infos = parameters_;
    return p[R] == infos[R].upper && p[r] == infos[r].lower && p[waist] == infos[waist].upper;
  }

  /// Mistakes away from the defaults, behind the option, or in the process.
  void spoil(std::span<const double> p, Primitive& right) const
  {
    Vec3& x = right.position;
    x.y() += whim(defect_, this, p[R]) * p[R];
    if (is("slow")) wait(0.15);
    if (is("turns_far") && is_far(p)) right.rotation = rotation_exp(Vec3(0.0, 0.0, p[waist] - 1.5));
    if (is("turns_behind_option") && crossed_) right.rotation = rotation_exp(Vec3(0.0, 0.0, p[waist]));
    if (is("jump_far") && is_far(p)) x.y() += 1e-3 * p[R];
    if (is("jump_of_r_far") && p[r] > 1.5) x.y() += 1e-3 * p[R];
    if (is("needle") && std::abs(p[R] - 31.4159) < 1e-5) x.y() += 1e-3 * p[R];
    if (is("kink_far") && is_far(p)) x.y() += 0.1 * (p[R] - 20.0);
    if (is("throws_in_corner") && is_corner(p)) throw std::out_of_range("vector::at");
    if (is("not_a_number_in_corner") && is_corner(p)) x.y() = std::nan("");
    if (is("refuses_without_name_far") && is_far(p)) throw InputError("out of range");
    if (is("single_precision")) x.x() = static_cast<float>(x.x());
    if (is("forgets_r")) right.size = {p[R], 0.1, 0.1};
    if (is("forgets_R")) x.x() = 2.5 * p[waist];
    if (is("length_behind_option") && crossed_) x.y() += 0.1;
    if (is("unknown_kind_behind_option") && crossed_) right.kind = static_cast<PrimitiveKind>(17);
    if (is("two_radii")) right.size[2] *= 1.1;
    if (is("throws_behind_option") && crossed_) throw std::runtime_error("not crossed yet");
    if (is("mirrored")) right.rotation.col(0) *= -1.0;
    if (is("name_behind_bound") && p[waist] > 1.95) right.name = "far";
    if (is("factor")) x.x() *= 1.02;
  }

  void spoil(std::span<const double> p, PrimitiveJacobian& J) const
  {
    double& x_waist = J[0 * 3 + waist];
    if (is("sign_behind_option") && crossed_) x_waist *= -1.0;
    if (is("nearly_right_behind_option") && crossed_) x_waist *= 1.0 + 1e-6;
    if (is("sign_far") && is_far(p)) x_waist *= -1.0;
    if (is("off_by_1e-9_R")) J[2 * 3 + r] += 1e-9;
    if (is("of_the_other_ring")) J[0 * 3 + R] *= -1.0;
    if (is("kink_far") && is_far(p)) J[1 * 3 + R] += 0.1;
    if (is("jump_far") && is_far(p)) J[1 * 3 + R] += 1e-3;
    if (is("jump_of_r_far") && p[r] > 1.5) J[1 * 3 + R] += 1e-3;
    if (is("jacobian_throws_in_corner") && is_corner(p)) throw std::out_of_range("vector::at");
    if (is("too_few_rows_behind_option") && crossed_) J.resize(9);
    if (is("jacobian_rounds_down")) std::fesetround(FE_DOWNWARD);
    if (is("forgets_r")) J[4 * 3 + r] = J[5 * 3 + r] = 0.0;
    if (is("forgets_R")) J[0 * 3 + R] = 0.0, x_waist = 2.5;
    if (is("length_in_jacobian")) x_waist = 2.5;
    if (is("factor")) J[0 * 3 + R] *= 1.02, x_waist *= 1.02;
  }

  std::unique_ptr<Shape> inner_;
  std::string defect_;
  bool crossed_;
  std::vector<ParameterInfo> parameters_;
  mutable double scratch_ = 0.0;
};

void fields(std::vector<Field>& out)
{
  reference_plugin.fields(out);
  add_defect_field(out);
}

std::unique_ptr<Shape> make(const Node& section, Problems& problems)
{
  const std::string defect = defect_of(section);
  const bool crossed = section.at("crossed").boolean;
  if (defect == "make_moves") disturb("directory");
  if (defect == "make_throws_behind_option" && crossed) throw std::bad_alloc();
  if (defect == "make_returns_nothing_behind_option" && crossed) return nullptr;
  if (defect == "unnamed_problem" && crossed) problems.add({"", 0, "something is wrong"});
  return std::make_unique<Mutant>(reference_plugin.make_shape(without_defect(section), problems), defect,
                                  crossed);
}

}  // namespace
}  // namespace hauberk::mutants

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {HAUBERK_HANDSHAKE,
                                                                                 hauberk::PluginKind::shape,
                                                                                 "mutant_shape",
                                                                                 "1.0",
                                                                                 "A shape with a defect.",
                                                                                 "none",
                                                                                 hauberk::mutants::fields,
                                                                                 hauberk::mutants::make,
                                                                                 nullptr,
                                                                                 nullptr};
