#include "strut_frame.hpp"

#include <hauberk/error.hpp>

#include <algorithm>
#include <cmath>

namespace hauberk {

void strut_frame_fields(std::vector<Field>& out)
{
  Field polyhedron;
  polyhedron.name = "polyhedron";
  polyhedron.kind = Field::Kind::choice;
  polyhedron.doc =
      "A cage by name, with edges of length 1 before it is multiplied by the parameter size; the other parameter, r, is the radius of struts "
      "and of their ends. A square lies in z = 0 with edges along x and y, a tetrahedron has an upper edge along x and a lower one along "
      "y, a cube edges along the axes, an octahedron corners on them. Exactly one of this, file and nodes.";
  for (const Polyhedron& p : polyhedra()) polyhedron.choices.emplace_back(p.name);
  out.push_back(polyhedron);

  Field file;
  file.name = "file";
  file.kind = Field::Kind::string;
  file.unit = "file";
  file.doc = "A Wavefront OBJ file, of which lines (l) and outlines of faces (f) are struts.";
  out.push_back(file);

  Field node;
  node.name = "node";
  node.kind = Field::Kind::numbers;
  node.doc = "Place of one node.";
  node.min_items = node.max_items = 3;
  Field nodes;
  nodes.name = "nodes";
  nodes.kind = Field::Kind::list;
  nodes.doc = "Places of nodes, before they are multiplied by the parameter size.";
  nodes.min_items = 2;
  nodes.children = {node};
  out.push_back(nodes);

  Field strut = node;
  strut.name = "strut";
  strut.doc = "The two nodes of one strut, counted from 0.";
  strut.min_items = strut.max_items = 2;
  strut.minimum = 0.0;
  Field struts = nodes;
  struts.name = "struts";
  struts.doc = "The struts between nodes.";
  struts.min_items = 1;
  struts.children = {strut};
  out.push_back(struts);
}

namespace {

/// The graph of `nodes` and `struts`; numbers of nodes that are none are problems.
Graph listed(const Node& nodes, const Node& struts, Problems& problems)
{
  Graph graph;
  for (const Node& node : nodes.items) {
    const std::vector<double> x = node.numbers();
    graph.nodes.emplace_back(x[0], x[1], x[2]);
  }
  for (const Node& strut : struts.items) {
    const std::vector<double> ends = strut.numbers();
    for (const double end : ends)
      if (end != std::floor(end) || end >= static_cast<double>(graph.nodes.size())) {
        problems.add(strut, "two numbers of nodes expected, whole and counted from 0");
        return graph;
      }
    graph.struts.push_back({static_cast<int>(ends[0]), static_cast<int>(ends[1])});
  }
  return graph;
}

}  // namespace

std::unique_ptr<Shape> make_strut_frame(const Node& section, Problems& problems)
{
  const Node *polyhedron = section.find("polyhedron"), *file = section.find("file"),
             *nodes = section.find("nodes"), *struts = section.find("struts");
  if ((polyhedron != nullptr) + (file != nullptr) + (nodes != nullptr) != 1 ||
      (nodes == nullptr) != (struts == nullptr)) {
    problems.add(section, "expected exactly one of polyhedron, file, and nodes with struts");
    return nullptr;
  }
  if (file != nullptr) return std::make_unique<StrutFrame>(read_obj_lines(file->string));
  if (polyhedron != nullptr) {
    const std::span<const Polyhedron> all = polyhedra();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Polyhedron& p) { return polyhedron->string == p.name; });
    return std::make_unique<StrutFrame>(found->graph());
  }
  const std::size_t before = problems.list().size();
  Graph graph = listed(*nodes, *struts, problems);
  if (problems.list().size() > before) return nullptr;
  return std::make_unique<StrutFrame>(std::move(graph));
}

}  // namespace hauberk
