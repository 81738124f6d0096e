#pragma once
/// A certified lower bound of how far distances outside a surface have one foot.

#include <hauberk/kit/curvature_bounds.hpp>

namespace hauberk::kit {

/// A surface as a tree of cells, each with two halves that are made when asked for. Normals of a surface of
/// revolution meet its axis or are parallel to it, so that double normals lie in planes through the axis:
/// there the meridian u = 0 and the one opposite are all.
template <class Author>
class SurfaceTree {
 public:
  struct Node {
    SurfaceCell cell;
    int first_half = -1;  ///< the second half is next
  };

  explicit SurfaceTree(const double* q) : q_(q), domain_(ChartDomain::of<Author>(q))
  {
    const double half_u = domain_.revolved ? 0.0 : domain_.half_u(), half_v = domain_.half_v();
    for (int i = 0; i < columns(); ++i)
      for (int j = 0; j < domain_.rows(); ++j) {
        const double u = domain_.revolved ? std::numbers::pi * i : (2 * i + 1) * half_u;
        nodes_.push_back({surface_cell<Author, false>(q, u, (2 * j + 1) * half_v, half_u, half_v)});
      }
    for (const Node& n : nodes_) size_ = std::max(size_, n.cell.x.norm());
  }

  const SurfaceCell& cell(int k) const { return nodes_[k].cell; }
  int roots() const { return columns() * domain_.rows(); }
  /// The first cells of pairs.
  int first_roots() const { return domain_.revolved ? domain_.rows() : roots(); }
  int size() const { return static_cast<int>(nodes_.size()); }

  /// The first of a cell's two halves, across its longer side in space.
  int halves(int k)
  {
    if (nodes_[k].first_half >= 0) return nodes_[k].first_half;
    SurfaceCell c = nodes_[k].cell;
    const bool across_u = c.is_wider_in_u(size_);
    double& half = across_u ? c.half_u : c.half_v;
    half *= 0.5;
    nodes_[k].first_half = size();
    const int first = nodes_[k].first_half;
    for (const double side : {-half, half})
      nodes_.push_back({surface_cell<Author, false>(q_, c.u + (across_u ? side : 0.0),
                                                    c.v + (across_u ? 0.0 : side), c.half_u, c.half_v)});
    return first;
  }

 private:
  int columns() const { return domain_.revolved ? 2 : ChartDomain::columns; }

  const double* q_;
  ChartDomain domain_;
  std::vector<Node> nodes_;
  double size_ = 0.0;
};

/// Lower bound of the reach of a solid: of the largest tau such that no ball of a smaller radius that touches
/// the surface from outside holds another point of it. Points outside that are nearer have one foot (Federer
/// 1959, Curvature measures, theorem 4.8).
///
/// The reach is the least of 1/concave, where -concave is the least principal curvature, and half the length
/// of the shortest double normal outside: a segment from x to y with n(x) = (y - x)/|y - x| = -n(y). For a
/// ball of that radius touches at two points x and y or, in the limit, twice at one, which bends as the ball
/// does. Between x and y the solid has a path of length at most 2 tau arcsin(|y - x|/(2 tau)), which lies in
/// the ball (Boissonnat, Lieutier and Wintraecken 2019, The reach, metric distortion, geodesic convexity and
/// the variation of tangent spaces, theorem 1 and corollary 1). The ball holds no inner point of the solid,
/// so that the path is its great arc and the surface bends as the ball does there, unless x and y are
/// opposite. Aamari et al. 2019, Estimating the reach of a manifold, theorem 3.4, is the same of manifolds.
///
/// Double normals shorter than 2 tau are excluded pair by pair of cells. Over a cell points are within `path`
/// of its middle and normals within `turn` of the normal there.
template <class Author>
class ReachSearch {
 public:
  /// `concave` is an upper bound over the surface.
  ReachSearch(const double* q, double concave) : concave_(concave), tree_(q) {}

  double bound()
  {
    if (!(concave_ > 0.0)) return std::numeric_limits<double>::infinity();
    constexpr double share = 0.9, smaller = 0.8;
    double radius = std::min(share * sampled(), 1.0 / concave_);
    for (int k = 0; k < 9; ++k, radius *= smaller)
      if (excluded(radius, 300000)) return radius;
    return 0.0;
  }

 private:
  struct Pair {
    int a, b;
  };

  /// The least |y - x|^2/(2 <y - x, n(x)>) among middles of cells, the radius of the ball at x through y.
  double sampled() const
  {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < tree_.first_roots(); ++i)
      for (int j = 0; j < tree_.roots(); ++j) {
        const Vec3 d = tree_.cell(j).x - tree_.cell(i).x;
        const double height = d.dot(tree_.cell(i).frame.col(2)), square = d.squaredNorm();
        if (height * 2.0 * least > square && height > 1e-9 * std::sqrt(square)) least = 0.5 * square / height;
      }
    return least;
  }

  /// Whether no double normal outside is shorter than 2 t.
  bool excluded(double t, int budget)
  {
    const int most_cells = tree_.size() + 6000;
    std::vector<Pair> open;
    for (int a = 0; a < tree_.first_roots(); ++a)
      for (int b = a; b < tree_.roots(); ++b) open.push_back({a, b});
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (has_none(tree_.cell(a), tree_.cell(b), 2.0 * t)) continue;
      if (--budget < 0 || tree_.size() > most_cells) return false;
      const bool halve_a = width(tree_.cell(a), t) >= width(tree_.cell(b), t);
      const int h = tree_.halves(halve_a ? a : b);
      if (a == b)
        open.insert(open.end(), {{h, h}, {h, h + 1}, {h + 1, h + 1}});
      else
        open.insert(open.end(),
                    {halve_a ? Pair{h, b} : Pair{a, h}, halve_a ? Pair{h + 1, b} : Pair{a, h + 1}});
    }
    return true;
  }

  /// What a cell adds to how far points may be from the line through two points and along a normal.
  static double width(const SurfaceCell& c, double length) { return c.path + length * c.turn; }

  /// Whether no double normal outside that is shorter than `length` joins the cells.
  static bool has_none(const SurfaceCell& a, const SurfaceCell& b, double length)
  {
    const Vec3 na = a.frame.col(2), nb = b.frame.col(2), d = b.x - a.x;
    const double turn_a = a.turn, turn_b = b.turn, off = (a.path + b.path) * (1.0 + 1e-9);
    const double opposite = turn_a + turn_b + 1e-9;
    if ((na + nb).squaredNorm() > opposite * opposite) return true;
    const double far = d.norm(), longest = far + off;
    if (far - off >= length) return true;
    // Outside, d = l n(x) with l within `off` of `far`, so that d is within off + l turn of l n_a, and of -l
    // n_b.
    const double along_a = d.dot(na), along_b = -d.dot(nb);
    const double off_a = off + longest * turn_a, off_b = off + longest * turn_b;
    if (along_a + off_a < std::max(0.0, far - off) || along_b + off_b < std::max(0.0, far - off)) return true;
    return (d - along_a * na).squaredNorm() > off_a * off_a ||
           (d + along_b * nb).squaredNorm() > off_b * off_b;
  }

  double concave_;
  SurfaceTree<Author> tree_;
};

}  // namespace hauberk::kit
