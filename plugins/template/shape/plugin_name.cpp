/// A figure of eight: two equal round rings side by side, welded into one rigid link.

#include <hauberk/error.hpp>
#include <hauberk/plugin.hpp>

#include <fmt/format.h>

namespace {

using namespace hauberk;

class PluginName final : public Shape {
 public:
  explicit PluginName(bool crossed)
      : parameters_{{"R", "length", 5.0, 1e-12, 1e12, "radius of both rings"},
                    {"r", "length", 0.7, 1e-12, 1e12, "radius of their tubes"},
                    {"waist", "1", 1.5, 1.0, 2.0, "distance of the rings' centres over R"}}
  {
    if (crossed) right_ = rotation_exp(Vec3(90.0 * degree, 0.0, 0.0));
  }

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }

  void do_primitives(std::span<const double> p, std::vector<Primitive>& out) const override
  {
    if (p[r] >= p[R])
      throw InputError(
          fmt::format("parameter 'r' = {} must be smaller than 'R' = {}: it closes the rings", p[r], p[R]));
    for (const double side : {-1.0, 1.0}) {
      Primitive ring;
      ring.name = side < 0.0 ? "left" : "right";
      ring.kind = PrimitiveKind::circle_tube;
      ring.position = Vec3(side * 0.5 * p[waist] * p[R], 0.0, 0.0);
      if (side > 0.0) ring.rotation = right_;
      ring.size = {p[R], p[r], p[r]};
      out.push_back(ring);
    }
  }

  void do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const override
  {
    // Rows are position x, y, z and size 0, 1, 2; columns are the parameters.
    const std::size_t columns = p.size();
    for (const double side : {-1.0, 1.0}) {
      PrimitiveJacobian J(primitive_dofs * columns, 0.0);
      J[0 * columns + R] = side * 0.5 * p[waist];
      J[0 * columns + waist] = side * 0.5 * p[R];
      J[3 * columns + R] = 1.0;
      J[4 * columns + r] = 1.0;
      J[5 * columns + r] = 1.0;
      out.push_back(J);
    }
  }

 private:
  enum { R, r, waist };  // order of the parameters
  std::vector<ParameterInfo> parameters_;
  Mat3 right_ = Mat3::Identity();
};

/// Settings of the section of an experiment; what is not declared here is refused before the factory is
/// called.
void fields(std::vector<Field>& out)
{
  Field crossed;
  crossed.name = "crossed";
  crossed.kind = Field::Kind::boolean;
  crossed.doc = "Whether the right ring is turned by 90 degrees about the line through both centres.";
  crossed.default_json = "false";
  out.push_back(crossed);
}

std::unique_ptr<Shape> make(const Node& section, Problems& /*problems*/)
{
  return std::make_unique<PluginName>(section.at("crossed").boolean);
}

}  // namespace

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "plugin_name",
    "0.1.0",
    "Two equal round rings side by side, as one rigid link.",
    "your publication",
    fields,
    make,
    nullptr,
    nullptr,
};
