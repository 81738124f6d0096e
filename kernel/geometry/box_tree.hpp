#pragma once
/// Binary tree of axis-aligned boxes around the triangles of a mesh.

#include "geometry/facets.hpp"

#include <algorithm>
#include <numeric>

namespace hauberk {

/// Centre and half-widths.
struct Box {
  Vec3 center, half;
};

inline Box box_around(const std::array<Vec3, 3>& corners)
{
  const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  return {0.5 * (low + high), 0.5 * (high - low)};
}

/// Split at the median of centres along the longest side; one triangle a leaf. Nodes are in depth-first
/// order.
class Facets::Tree {
 public:
  struct Node {
    Box box;
    int left = -1, right = -1;  ///< -1: a leaf
    int triangle = -1;
    double size = 0.0;  ///< sum of half-widths
  };

  explicit Tree(const std::vector<Box>& boxes)
  {
    std::vector<int> order(boxes.size());
    std::iota(order.begin(), order.end(), 0);
    nodes_.reserve(2 * boxes.size());
    build(boxes, order.data(), order.size());
  }

  const Node& node(int k) const { return nodes_[k]; }

 private:
  int build(const std::vector<Box>& boxes, int* begin, std::size_t count)
  {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t k = 0; k < count; ++k) {
      const Box& b = boxes[begin[k]];
      low = low.cwiseMin(b.center - b.half);
      high = high.cwiseMax(b.center + b.half);
    }
    const auto number = nodes_.size();
    Node node;
    node.box = {0.5 * (low + high), 0.5 * (high - low)};
    node.size = node.box.half.sum();
    if (count == 1) node.triangle = *begin;
    nodes_.push_back(node);
    if (count == 1) return static_cast<int>(number);

    int axis = 0;
    node.box.half.maxCoeff(&axis);
    const std::size_t middle = count / 2;
    std::nth_element(begin, begin + middle, begin + count, [&](int a, int b) {
      const double x = boxes[a].center[axis];
      const double y = boxes[b].center[axis];
      return x < y || (x == y && a < b);  // the tree must not depend on how elements are permuted
    });
    const int left = build(boxes, begin, middle), right = build(boxes, begin + middle, count - middle);
    nodes_[number].left = left;
    nodes_[number].right = right;
    return static_cast<int>(number);
  }

  std::vector<Node> nodes_;
};

/// Calls visit(triangle of P, triangle of F) for every pair whose boxes are within `range` of each other
/// along F's axes. `axes`, `a`: P's axes and origin in F's frame. In a fixed order.
template <class Visit>
void visit_near(const Facets::Tree& P, const Facets::Tree& F, const Mat3& axes, const Vec3& a, double range,
                const Visit& visit)
{
  const Mat3 size = axes.cwiseAbs();
  std::vector<std::array<int, 2>> open;
  open.reserve(128);
  open.push_back({0, 0});
  while (!open.empty()) {
    const auto [kp, kf] = open.back();
    open.pop_back();
    const Facets::Tree::Node &p = P.node(kp), &f = F.node(kf);
    const Vec3 apart = (a + axes * p.box.center - f.box.center).cwiseAbs() - size * p.box.half - f.box.half;
    if (apart.maxCoeff() > range) continue;
    // Boxes that are apart along two axes are further apart than along each.
    if (apart.cwiseMax(0.0).squaredNorm() > range * range) continue;
    if (p.left < 0 && f.left < 0) {
      visit(p.triangle, f.triangle);
    } else if (f.left < 0 || (p.left >= 0 && p.size >= f.size)) {
      open.push_back({p.right, kf});
      open.push_back({p.left, kf});
    } else {
      open.push_back({kp, f.right});
      open.push_back({kp, f.left});
    }
  }
}

}  // namespace hauberk
