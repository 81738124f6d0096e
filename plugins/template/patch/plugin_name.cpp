/// A finite patch, such as one in a round frame, that is stretched or compressed alike in all directions.

#include <hauberk/kit/plugin_table.hpp>

namespace {

using namespace hauberk;

/// One macroscopic unknown, the strain e: x = (1 + e) X + u, with a displacement u in the plane for every
/// element. A patch has no lattice, so nothing repeats, and T is zero.
class PluginName final : public LoadCase {
 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return 2; }
  int do_lattice_vectors() const override { return 0; }

  void do_position(std::span<const double> macro, std::span<const double> u, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override
  {
    const Vec3 rest = X + T;
    out.x = rest + Vec3(macro[0] * rest.x() + u[0], macro[0] * rest.y() + u[1], 0.0);
    out.J.col(0) = Vec3(rest.x(), rest.y(), 0.0);  // dx/de
    out.J(0, 1) = out.J(1, 2) = 1.0;               // dx/du
  }

  void do_load(double /*theta*/, std::span<double> t) const override { t[0] = 1.0; }
  std::string do_measure() const override { return "isotropic"; }
  std::pair<std::string, std::string> do_sense_names() const override { return {"stretch", "compress"}; }

  /// A convex set with rest in it, on which the patch is not turned inside out.
  bool do_admissible(std::span<const double> macro) const override { return 1.0 + macro[0] > 0.0; }
  /// Where nothing holds the patch it ends as a runaway, from 1e3 on.
  std::pair<double, double> do_stretch_range(std::span<const double> macro) const override
  {
    return {1.0 + macro[0], 1.0 + macro[0]};
  }

  /// Nothing holds the place of a patch, and displacements could undo the strain: their mean, their turn
  /// about z and their part along X are zero, so that e is the strain that fits the patch best. From the mean
  /// place on, these conditions are independent, of elements in a line as well.
  std::vector<LinearEquality> do_equalities(std::span<const Vec3> X) const override
  {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& place : X) mean += place / static_cast<double>(X.size());
    LinearEquality mean_x{"mean x", {}}, mean_y{"mean y", {}}, turn{"turn about z", {}}, size{"size", {}};
    double extent = 0.0;
    for (int i = 0; i < static_cast<int>(X.size()); ++i) {
      const Vec3 from = X[i] - mean;
      mean_x.terms.push_back({i, 0, 1.0});
      mean_y.terms.push_back({i, 1, 1.0});
      turn.terms.insert(turn.terms.end(), {{i, 0, -from.y()}, {i, 1, from.x()}});
      size.terms.insert(size.terms.end(), {{i, 0, from.x()}, {i, 1, from.y()}});
      extent += from.head<2>().norm();
    }
    if (!(extent > 1e-9)) return {mean_x, mean_y};  // a single element
    return {mean_x, mean_y, turn, size};
  }

 private:
  std::vector<MacroInfo> macros_{{"e", 0}};
};

/// `length` is the scene's characteristic length: lengths in the section are divided by it.
std::unique_ptr<LoadCase> make(const Node& /*section*/, double /*length*/, Problems& /*problems*/)
{
  return std::make_unique<PluginName>();
}

}  // namespace

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = hauberk::kit::load_case_table(
    {"plugin_name", "0.1.0", "Finite patch stretched or compressed alike in all directions.",
     "your publication"},
    hauberk::kit::no_fields, make);
