#include "document/field_helpers.hpp"
#include "rotation.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/union_shape.hpp>

#include <utility>

namespace hauberk {

namespace {

constexpr std::size_t coordinates = 3;
constexpr const char* coordinate_names[coordinates] = {"x", "y", "z"};
constexpr double farthest = 1e12;  ///< wide enough for any unit of length

/// Runs a call into a part's shape; what is wrong there names the part.
template <class Call>
auto of_part(const std::string& name, Call&& call)
{
  try {
    return call();
  } catch (const InputError& error) {
    throw InputError("part '" + name + "': " + error.what());
  } catch (const PluginError& error) {
    throw PluginError("part '" + name + "': " + error.what());
  }
}

/// Adds the Jacobian `own` of a part's primitive to `J`, whose rows have `count` entries; the part's `n`
/// parameters begin at `first`, and its position follows them.
void place_jacobian(const PrimitiveJacobian& own, std::size_t n, const Mat3& A, std::size_t first,
                    std::size_t count, PrimitiveJacobian& J)
{
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 dx = A * Vec3(own[k], own[n + k], own[2 * n + k]);
    for (std::size_t i = 0; i < coordinates; ++i) J[i * count + first + k] = dx[static_cast<Eigen::Index>(i)];
    for (std::size_t row = coordinates; row < J.size() / count; ++row)
      J[row * count + first + k] = own[row * n + k];
  }
  for (std::size_t i = 0; i < coordinates; ++i) J[i * count + first + n + i] = 1.0;
}

void union_fields(std::vector<Field>& out)
{
  using namespace fields;
  Field part =
      object(union_part_field,
             "A part: a shape with the fields of its plugin, and its place. It cannot be a union itself.",
             {required(string("name", "Name of the part, unique in the element.")),
              required(string("shape", "Plugin that turns the part's parameters into primitives.")),
              with_default(in_unit(numbers("position",
                                           "Place of the part's origin in the element frame: defaults of "
                                           "its parameters NAME.x, NAME.y and NAME.z.",
                                           3),
                                   "length"),
                           "[0, 0, 0]"),
              rotation_field("part")});
  Field parts =
      list("parts",
           "What the element is made of; parts may overlap, and are one body in any case. "
           "`parameters` gives those of all parts, each by the name of its part, a dot and its name "
           "there.",
           std::move(part));
  out.push_back(required(at_least_items(std::move(parts), 1)));
}

constexpr PluginTable table = {
    HAUBERK_HANDSHAKE,
    PluginKind::shape,
    "union",
    "0.1.0",
    "Rigid union of parts of any shapes; built in.",
    "none",
    union_fields,
    nullptr,
    nullptr,
    nullptr,
};

}  // namespace

const PluginTable& union_table() { return table; }

UnionShape::UnionShape(std::vector<UnionPart> parts) : parts_(std::move(parts))
{
  for (const UnionPart& part : parts_) {
    first_.push_back(parameters_.size());
    for (ParameterInfo info : part.shape->parameters()) {
      info.name = part.name + "." + info.name;
      parameters_.push_back(std::move(info));
    }
    for (std::size_t i = 0; i < coordinates; ++i) {
      const std::string coordinate = coordinate_names[i];
      parameters_.push_back({part.name + "." + coordinate, "length",
                             part.position[static_cast<Eigen::Index>(i)], -farthest, farthest,
                             coordinate + " of the part's origin in the element frame", true});
    }
  }
  first_.push_back(parameters_.size());
}

void UnionShape::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  out.clear();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const UnionPart& part = parts_[k];
    const std::span<const double> own = p.subspan(first_[k], first_[k + 1] - first_[k]);
    const std::size_t n = own.size() - coordinates;
    const Vec3 position(own[n], own[n + 1], own[n + 2]);
    for (Primitive& primitive : of_part(part.name, [&] { return part.shape->primitives(own.first(n)); })) {
      primitive.name = part.name + "." + primitive.name;
      primitive.position = position + part.rotation * primitive.position;
      primitive.rotation = part.rotation * primitive.rotation;
      out.push_back(std::move(primitive));
    }
  }
}

void UnionShape::do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const
{
  out.clear();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const UnionPart& part = parts_[k];
    const std::size_t n = first_[k + 1] - first_[k] - coordinates;
    const std::span<const double> own = p.subspan(first_[k], n);
    const auto [primitives, jacobians] = of_part(
        part.name, [&] { return std::make_pair(part.shape->primitives(own), part.shape->jacobians(own)); });
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      // A shape without parameters has empty Jacobians, so the number of rows is asked of the primitive.
      const auto rows = static_cast<std::size_t>(geometric_dofs(primitives[i]));
      PrimitiveJacobian J(rows * p.size(), 0.0);
      place_jacobian(jacobians[i], n, part.rotation, first_[k], p.size(), J);
      out.push_back(std::move(J));
    }
  }
}

}  // namespace hauberk
