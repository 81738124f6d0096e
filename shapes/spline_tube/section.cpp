#include "spline_tube.hpp"

#include <set>

namespace hauberk {
namespace {

constexpr int least_nodes = 3, most_nodes = 64;

}  // namespace

void spline_tube_fields(std::vector<Field>& out)
{
  Field node;
  node.name = "node";
  node.kind = Field::Kind::numbers;
  node.doc = "Place and radius at one node: x, y, z, r.";
  node.min_items = node.max_items = 4;
  Field nodes;
  nodes.name = "nodes";
  nodes.kind = Field::Kind::list;
  nodes.required = true;
  nodes.min_items = least_nodes;
  nodes.max_items = most_nodes;
  nodes.doc =
      "What the tube passes, in this order and back to the first: x, y, z and its radius, the defaults of the "
      "parameters p0.x, p0.y, p0.z, p0.r, p1.x and so on. Between nodes places and radii follow a spline of "
      "degree 5.";
  nodes.children = {node};
  out.push_back(nodes);
}

std::unique_ptr<Shape> make_spline_tube(const Node& section, Problems& problems)
{
  const Node& nodes = section.at("nodes");
  std::vector<double> values;
  std::set<std::vector<double>> places;
  const std::size_t before = problems.list().size();
  for (const Node& node : nodes.items) {
    const std::vector<double> x = node.numbers();
    if (!(x[3] > 0.0)) problems.add(node, "the radius, the last number, has to be above 0");
    if (!places.emplace(x.begin(), x.begin() + 3).second) problems.add(node, "two nodes are at one place");
    values.insert(values.end(), x.begin(), x.end());
  }
  if (problems.list().size() != before) return nullptr;
  return std::make_unique<SplineTube>(std::move(values));
}

}  // namespace hauberk
