#include "guarded.hpp"

namespace hauberk {
namespace {

/// `position` is in the innermost loops: what cannot change is asked for once, and the guard adds a few
/// nanoseconds to the call itself.
class GuardedLoadCase final : public LoadCase {
 public:
  GuardedLoadCase(std::unique_ptr<const LoadCase> inner, const Guard& guard)
      : inner_(std::move(inner)),
        guard_(guard),
        macros_(guard_("macros", [&] { return inner_->macros(); })),
        coordinate_count_(guard_("coordinate_count", [&] { return inner_->coordinate_count(); })),
        lattice_vectors_(guard_("lattice_vectors", [&] { return inner_->lattice_vectors(); }))
  {
  }

 protected:
  using Values = std::span<const double>;

  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return coordinate_count_; }
  int do_lattice_vectors() const override { return lattice_vectors_; }
  void do_position(Values macro, Values e, const Vec3& X, const Vec3& T, PositionMap& out) const override
  {
    guard_("position", [&] { inner_->position(macro, e, X, T, out); });
  }
  double do_acceleration_bound(Values macro, Values dmacro, Values e, Values de, const Vec3& X,
                               const Vec3& T) const override
  {
    return guard_("acceleration_bound",
                  [&] { return inner_->acceleration_bound(macro, dmacro, e, de, X, T); });
  }
  bool do_admissible(Values macro) const override
  {
    return guard_("admissible", [&] { return inner_->admissible(macro); });
  }
  std::pair<double, double> do_stretch_range(Values macro) const override
  {
    return guard_("stretch_range", [&] { return inner_->stretch_range(macro); });
  }
  void do_load(double theta, std::span<double> t) const override
  {
    guard_("load", [&] { inner_->load(Direction::at_radians(theta), t); });
  }
  double do_value(double theta, Values macro) const override
  {
    return guard_("value", [&] { return inner_->value(Direction::at_radians(theta), macro); });
  }
  std::string do_measure() const override
  {
    return guard_("measure", [&] { return inner_->measure(); });
  }
  int do_value_length_power() const override
  {
    return guard_("value_length_power", [&] { return inner_->value_length_power(); });
  }
  std::vector<std::pair<std::string, double>> do_companions(double theta, Values macro) const override
  {
    return guard_("companions", [&] { return inner_->companions(Direction::at_radians(theta), macro); });
  }
  std::pair<std::string, std::string> do_sense_names() const override
  {
    return guard_("sense_names", [&] { return inner_->sense_names(); });
  }
  void do_metric(std::span<double> m) const override
  {
    guard_("metric", [&] { inner_->metric(m); });
  }
  bool do_transform(const Mat3& O, Values macro, std::span<double> out) const override
  {
    return guard_("transform", [&] { return inner_->transform(O, macro, out); });
  }
  std::vector<LinearInequality> do_inequalities(std::span<const Vec3> X) const override
  {
    return guard_("inequalities", [&] { return inner_->inequalities(X); });
  }
  std::vector<LinearEquality> do_equalities(std::span<const Vec3> X) const override
  {
    return guard_("equalities", [&] { return inner_->equalities(X); });
  }
  Boundedness do_boundedness(Values load, std::span<const Vec3> cycles) const override
  {
    return guard_("boundedness", [&] { return inner_->boundedness(load, cycles); });
  }
  std::vector<std::string> do_hold() const override
  {
    return guard_("hold", [&] { return inner_->hold(Direction()); });
  }
  std::vector<MacroCondition> do_conditions(double theta) const override
  {
    return guard_("conditions", [&] { return inner_->conditions(Direction::at_radians(theta)); });
  }
  Boundedness do_held_boundedness(double theta, Values load, std::span<const Vec3> cycles) const override
  {
    return guard_("held_boundedness", [&] { return inner_->held_boundedness(theta, load, cycles); });
  }
  bool do_bends() const override
  {
    return guard_("bends", [&] { return inner_->bends(); });
  }
  std::string do_not_a_sheet(const SheetState& state) const override
  {
    return guard_("not_a_sheet", [&] { return inner_->not_a_sheet(state); });
  }

  std::vector<StricterLoadCase> do_stricter() const override
  {
    std::vector<StricterLoadCase> out = guard_("stricter", [&] { return inner_->stricter(); });
    for (StricterLoadCase& s : out) s.load = std::make_unique<GuardedLoadCase>(std::move(s.load), guard_);
    return out;
  }
  bool do_contains(const LoadCase& other) const override
  {
    // Plugins know their own load cases, not what guards them.
    const auto* guarded = dynamic_cast<const GuardedLoadCase*>(&other);
    const LoadCase& inner = guarded == nullptr ? other : *guarded->inner_;
    return guard_("contains", [&] { return inner_->contains(inner); });
  }

 private:
  std::unique_ptr<const LoadCase> inner_;
  Guard guard_;
  std::vector<MacroInfo> macros_;
  int coordinate_count_;
  int lattice_vectors_;
};

}  // namespace

std::unique_ptr<LoadCase> guard_load_case(std::unique_ptr<LoadCase> load_case, const Guard& guard)
{
  return std::make_unique<GuardedLoadCase>(std::move(load_case), guard);
}

}  // namespace hauberk
