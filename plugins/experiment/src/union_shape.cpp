#include "document/field_helpers.hpp"
#include "rotation.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/union_shape.hpp>

#include <utility>

namespace hauberk {

namespace {

constexpr std::size_t coordinates = 3;
constexpr double farthest = 1e12;  ///< wide enough for any unit of length
/// Degrees. The rotation vector is at most sqrt(3) times as long, less than the full turn at which its
/// components no longer tell all rotations nearby.
constexpr double farthest_turn = 180.0;

/// The place of a part, and how its rotation turns with the three parameters of it.
struct Placed {
  Vec3 position;
  Mat3 rotation;
  Mat3 turns;  ///< columns, radians per degree

  /// From the last six of the part's parameters.
  Placed(const UnionPart& part, std::span<const double> place) : position(place[0], place[1], place[2])
  {
    const Vec3 w = degree * Vec3(place[3], place[4], place[5]);
    // A part that is not turned has the rotation of the experiment to the last bit.
    rotation = w == Vec3::Zero() ? part.rotation : Mat3(rotation_exp(w) * part.rotation);
    turns = degree * rotation_exp_jacobian(w);
  }
};

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

/// Columns of a Jacobian, one for each parameter.
class Columns {
 public:
  explicit Columns(std::size_t count, PrimitiveJacobian& J) : count_(count), J_(J) {}
  std::size_t rows() const { return J_.size() / count_; }
  double& at(std::size_t row, std::size_t column) { return J_[row * count_ + column]; }
  /// Into three rows.
  void set(std::size_t row, std::size_t column, const Vec3& v)
  {
    for (std::size_t i = 0; i < coordinates; ++i) at(row + i, column) = v[i];
  }

 private:
  std::size_t count_;
  PrimitiveJacobian& J_;
};

/// Adds the Jacobian `own` of the part's primitive at x to `J`; the part's `n` own parameters begin at
/// `first`, and its place follows them.
void place_jacobian(const PrimitiveJacobian& own, std::size_t n, const Vec3& x, const Placed& part,
                    std::size_t first, Columns& J)
{
  const std::size_t turn = J.rows() - rotation_dofs;
  const auto turned = [&](std::size_t row, std::size_t k) -> Vec3 {
    return part.rotation * Vec3(own[row * n + k], own[(row + 1) * n + k], own[(row + 2) * n + k]);
  };
  for (std::size_t k = 0; k < n; ++k) {
    J.set(0, first + k, turned(0, k));
    for (std::size_t row = coordinates; row < turn; ++row) J.at(row, first + k) = own[row * n + k];
    J.set(turn, first + k, turned(turn, k));
  }
  const Vec3 arm = part.rotation * x;
  for (std::size_t i = 0; i < coordinates; ++i) {
    const Vec3 omega = part.turns.col(i);
    J.at(i, first + n + i) = 1.0;
    J.set(0, first + n + coordinates + i, omega.cross(arm));
    J.set(turn, first + n + coordinates + i, omega);
  }
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
    for (std::size_t i = 0; i < coordinates; ++i)
      parameters_.push_back(
          {part.name + "." + place_parameters[i], "length", part.position[i], -farthest, farthest,
           std::string(place_parameters[i]) + " of the part's origin in the element frame", true});
    for (std::size_t i = coordinates; i < place_parameters.size(); ++i)
      parameters_.push_back(
          {part.name + "." + place_parameters[i], "degree", 0.0, -farthest_turn, farthest_turn,
           std::string(place_parameters[i]).substr(1) +
               " of the rotation vector that turns the part about its origin, in the element frame, beyond "
               "its rotation in the experiment",
           true});
  }
  first_.push_back(parameters_.size());
}

void UnionShape::do_primitives(std::span<const double> p, std::vector<Primitive>& out) const
{
  out.clear();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const UnionPart& part = parts_[k];
    const std::span<const double> own = p.subspan(first_[k], first_[k + 1] - first_[k]);
    const std::size_t n = own.size() - place_parameters.size();
    const Placed placed(part, own.subspan(n));
    for (Primitive& primitive : of_part(part.name, [&] { return part.shape->primitives(own.first(n)); })) {
      primitive.name = part.name + "." + primitive.name;
      primitive.position = placed.position + placed.rotation * primitive.position;
      primitive.rotation = placed.rotation * primitive.rotation;
      out.push_back(std::move(primitive));
    }
  }
}

void UnionShape::do_jacobians(std::span<const double> p, std::vector<PrimitiveJacobian>& out) const
{
  out.clear();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const UnionPart& part = parts_[k];
    const std::size_t n = first_[k + 1] - first_[k] - place_parameters.size();
    const std::span<const double> own = p.subspan(first_[k], n);
    const Placed placed(part, p.subspan(first_[k] + n, place_parameters.size()));
    const auto [primitives, jacobians] = of_part(
        part.name, [&] { return std::make_pair(part.shape->primitives(own), part.shape->jacobians(own)); });
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      // A shape without parameters has empty Jacobians, so the number of rows is asked of the primitive.
      const std::size_t rows = static_cast<std::size_t>(geometric_dofs(primitives[i])) + rotation_dofs;
      PrimitiveJacobian J(rows * p.size(), 0.0);
      Columns columns(p.size(), J);
      place_jacobian(jacobians[i], n, primitives[i].position, placed, first_[k], columns);
      out.push_back(std::move(J));
    }
  }
}

}  // namespace hauberk
