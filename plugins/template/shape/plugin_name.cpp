/// A figure of eight: two equal round rings side by side, welded into one rigid link.

#include <hauberk/error.hpp>
#include <hauberk/kit/fields.hpp>
#include <hauberk/kit/jet_shape.hpp>
#include <hauberk/kit/plugin_table.hpp>

#include <fmt/format.h>

namespace {

using namespace hauberk;

struct PluginName {
  enum { R, r, waist, parameter_count };  // order of the parameters
  bool crossed;

  static std::vector<ParameterInfo> parameters()
  {
    return {{"R", "length", 5.0, 1e-12, 1e12, "radius of both rings"},
            {"r", "length", 0.7, 1e-12, 1e12, "radius of their tubes"},
            {"waist", "1", 1.5, 1.0, 2.0, "distance of the rings' centres over R"}};
  }

  static void check(const double* p)
  {
    if (p[r] >= p[R])
      throw InputError(
          fmt::format("parameter 'r' = {} must be smaller than 'R' = {}: it closes the rings", p[r], p[R]));
  }

  /// S is a number, or a number with its derivatives in the parameters, which designs need.
  template <class S>
  void primitives(const S* p, std::vector<kit::Piece<S>>& out) const
  {
    for (const double side : {-1.0, 1.0}) {
      kit::Piece<S> ring;
      ring.name = side < 0.0 ? "left" : "right";
      ring.position[0] = side * 0.5 * p[waist] * p[R];
      if (crossed && side > 0.0) ring.rotation = rotation_exp(Vec3(90.0 * degree, 0.0, 0.0));
      ring.size = {p[R], p[r], p[r]};
      out.push_back(ring);
    }
  }
};

/// Settings of the section; what is not declared here is refused before the factory is called.
void fields(std::vector<Field>& out)
{
  out = {kit::boolean_field("crossed", false, "Whether the right ring is turned by 90 degrees.")};
}

std::unique_ptr<Shape> make(const Node& section, Problems& /*problems*/)
{
  return std::make_unique<kit::JetShape<PluginName>>(PluginName{section.at("crossed").boolean});
}

}  // namespace

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = hauberk::kit::shape_table(
    {"plugin_name", "0.1.0", "Two equal round rings side by side, as one rigid link.", "your publication"},
    fields, make);
