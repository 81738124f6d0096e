// The smallest correct shape. CMake defines PLUGIN_ID, and ALTERATION: a statement that may spoil the table.
#include <hauberk/plugin.hpp>

namespace hauberk {
namespace {

/// One round ring of fixed size.
class Ring final : public Shape {
 protected:
  const std::vector<ParameterInfo>& do_parameters() const override { return parameters_; }
  void do_primitives(std::span<const double>, std::vector<Primitive>& out) const override
  {
    Primitive ring;
    ring.name = "ring";
    ring.size = {5.0, 0.5, 0.5};
    out = {ring};
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    out.assign(1, PrimitiveJacobian{});
  }

 private:
  std::vector<ParameterInfo> parameters_;
};

void fields(std::vector<Field>&) {}

std::unique_ptr<Shape> make_ring(const Node&, Problems&) { return std::make_unique<Ring>(); }

[[maybe_unused]] std::unique_ptr<Optimizer> make_nothing(const Node&, Problems&) { return nullptr; }

constexpr PluginTable make_table()
{
  PluginTable table{
      HAUBERK_HANDSHAKE, PluginKind::shape, PLUGIN_ID, "1.0", "A ring for tests.", "none", fields,
      make_ring,         nullptr,           nullptr};
  ALTERATION;
  return table;
}

}  // namespace
}  // namespace hauberk

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = hauberk::make_table();
