/// A periodic sheet that is stretched or compressed alike in all directions of its plane.

#include <hauberk/kit/plugin_table.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace hauberk;

/// One macroscopic unknown, the strain e: x = (1 + e) (X + T) + u, with a displacement u in the plane for
/// every element. Images of an element are displaced by (1 + e) T, all alike.
class PluginName final : public LoadCase {
 protected:
  const std::vector<MacroInfo>& do_macros() const override { return macros_; }
  int do_coordinate_count() const override { return 2; }
  int do_lattice_vectors() const override { return 2; }

  void do_position(std::span<const double> macro, std::span<const double> u, const Vec3& X, const Vec3& T,
                   PositionMap& out) const override
  {
    const Vec3 rest = X + T;
    out.x = rest + Vec3(macro[0] * rest.x() + u[0], macro[0] * rest.y() + u[1], 0.0);
    out.J.col(0) = Vec3(rest.x(), rest.y(), 0.0);  // dx/de
    out.J(0, 1) = 1.0;                             // dx/du
    out.J(1, 2) = 1.0;
    // Affine in (e, u): not curved, and acceleration_bound stays 0.
  }

  // The angle does not matter: the value is e, and the load its derivative. What else a load case may say
  // (measure, metric, what is admissible) follows from these; see hauberk/load_case.hpp.
  void do_load(double /*theta*/, std::span<double> t) const override { t[0] = 1.0; }
  std::string do_measure() const override { return "isotropic"; }
  std::pair<std::string, std::string> do_sense_names() const override { return {"stretch", "compress"}; }

  /// A chain of links along any lattice vector ends the stretch; packing always ends the compression.
  Boundedness do_boundedness(std::span<const double> load, std::span<const Vec3> cycles) const override
  {
    const auto spans = [](const Vec3& T) { return std::hypot(T.x(), T.y()) > 1e-9; };
    if (load[0] <= 0.0 || std::any_of(cycles.begin(), cycles.end(), spans)) return Boundedness::attained;
    return Boundedness::unbounded;
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
    {"plugin_name", "0.1.0", "Periodic sheet stretched or compressed alike in all directions of its plane.",
     "your publication"},
    hauberk::kit::no_fields, make);
