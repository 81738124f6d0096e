#include "equilibrium/contact_energy.hpp"

#include "contact/barrier.hpp"
#include "contact/body_pair.hpp"
#include "model/near_pairs.hpp"
#include "numerics/parallel.hpp"

namespace hauberk {
namespace {

/// Most unknowns one pair can touch: macro, two elements' coordinates and rotations.
constexpr int most_local = max_macro + 2 * (max_coordinates + 3);
/// Pairs below which threads cost more than they save, and those that are kept before they are added.
constexpr std::size_t worth_threads = 128, most_at_once = 4096;
/// Of known panels so many are of use: every panel that an energy looks at is compared with all of them.
constexpr std::size_t most_near = 128;

/// A body that probes another one, and what that gave.
struct EvaluatedSide {
  int p = 0, f = 0;
  bool swapped = false;
  Mat3 M;  ///< axes of F
  SideTerms terms;
};

/// What a pair of elements adds to the energy.
struct PairWork {
  PositionMap image;     ///< of the second element, where it is that of another cell
  bool shifted = false;  ///< it is
  PairTerms sum;
  std::vector<EvaluatedSide> sides;
};

class Assembler {
 public:
  Assembler(const Model& model, const State& state, const ContactSettings& settings, const Request& request,
            const GapBounds* bounds)
      : m_(model),
        s_(state),
        settings_(settings),
        request_(request),
        bounds_(bounds),
        maps_(model.rest.size()),
        sparse_(model.sparse())
  {
    for (int i = 0; i < m_.element_count(); ++i) map(i, {0, 0}, maps_[i]);
    if (request_.order >= 1) out_.gradient = Vector::Zero(m_.dofs());
    if (request_.order >= 2 && !sparse_) out_.hessian = Matrix::Zero(m_.dofs(), m_.dofs());
    if (request_.parameters) {
      int most = 0;
      for (const int n : m_.parameter_count) most = std::max(most, n);
      out_.parameters = Matrix::Zero(most, m_.element_count());
    }
  }

  /// What a pair of elements adds: all that costs time, and depends on nothing but the pair.
  void evaluate(const ElementPair& pair, PairWork& work) const
  {
    work.sides.clear();
    const std::size_t i = pair.i, j = pair.j;
    work.shifted = pair.image != Image{};
    if (work.shifted) map(pair.j, pair.image, work.image);
    const Pose pi{maps_[i].x, s_.rotation[i]}, pj{map_of_j(pair, work).x, s_.rotation[j]};
    const double range = settings_.g_hat + settings_.clearance;
    if ((pi.position - pj.position).norm() >= m_.reach[i] + m_.reach[j] + range) return;
    work.sum = PairTerms{};
    for (int a = m_.first_body[i]; a < m_.first_body[i + 1]; ++a) {
      const Body& A = m_.bodies[a];
      const Vec3 ca = pi.position + pi.rotation * A.center;
      for (int b = m_.first_body[j]; b < m_.first_body[j + 1]; ++b) {
        const Body& B = m_.bodies[b];
        const Vec3 cb = pj.position + pj.rotation * B.center;
        if ((ca - cb).norm() >= A.bound + B.bound + range) continue;
        const KnownGap* known = bounds_ != nullptr ? bounds_->known(a, b, pair.image) : nullptr;
        NearPanels near;
        if (known != nullptr && known_to_be_far(*known, known->lost(A, pi, B, pj), near)) continue;
        for (const PairSide& side : pair_sides(A, B, settings_)) {
          const NearPanels& of_side = side.swapped == second_probes(A, B) ? near : everywhere_;
          side.swapped ? evaluate_side(b, a, pj, pi, side, of_side, work)
                       : evaluate_side(a, b, pi, pj, side, of_side, work);
        }
      }
    }
  }

  /// Adds it to the whole.
  void add(const ElementPair& pair, const PairWork& work)
  {
    bool any = false;
    for (const EvaluatedSide& side : work.sides) any |= add_side(pair, side, map_of_j(pair, work));
    if (any && request_.order >= 1) scatter(pair, maps_[pair.i], map_of_j(pair, work), work.sum);
  }

  void add_walls()
  {
    const int nc = m_.coordinate_count;
    for (std::size_t w = 0; w < m_.walls.size(); ++w) {
      const LinearInequality& wall = m_.walls[w];
      double g = wall.offset;
      for (const auto& t : wall.terms) g += t.coefficient * s_.e[t.element * nc + t.coordinate];
      out_.min_gap = std::min(out_.min_gap, g);
      if (g <= 0.0 || g >= settings_.g_hat) continue;
      const BarrierValue b = barrier<0>(g, settings_.g_hat);
      out_.energy += b.b;
      if (request_.order >= 1) {
        for (const auto& t : wall.terms)
          out_.gradient[m_.offset(t.element) + t.coordinate] += b.db * t.coefficient;
      }
      if (request_.order >= 2) {
        for (const auto& t : wall.terms) {
          for (const auto& r : wall.terms) {
            add_second(m_.offset(t.element) + t.coordinate, m_.offset(r.element) + r.coordinate,
                       b.ddb * t.coefficient * r.coefficient);
          }
        }
      }
      if (request_.points) {
        ContactEnergy::Point p;
        p.a = wall.terms.front().element;
        p.b = -1;
        p.wall = static_cast<int>(w);
        p.contact.gap = g;
        p.contact.force = -b.db;
        p.contact.on_p = p.contact.on_f = maps_[p.a].x;
        Vec3 n = Vec3::Zero();
        n[wall.terms.front().coordinate] = wall.terms.front().coefficient > 0 ? -1.0 : 1.0;
        p.contact.normal = n;  // towards the wall
        out_.points.push_back(p);
      }
    }
  }

  ContactEnergy take()
  {
    if (request_.order >= 2 && sparse_) {
      out_.sparse_hessian.resize(m_.dofs(), m_.dofs());
      // The diagonal is always there: factorisations shift it.
      for (int k = 0; k < m_.dofs(); ++k) second_.emplace_back(k, k, 0.0);
      out_.sparse_hessian.setFromTriplets(second_.begin(), second_.end());
    }
    return std::move(out_);
  }

 private:
  void map(int element, const Image& image, PositionMap& out) const
  {
    m_.load->position(
        s_.macro_values(),
        {s_.e.data() + element * m_.coordinate_count, static_cast<std::size_t>(m_.coordinate_count)},
        m_.rest[element].position, m_.translation(image), out);
  }

  void add_second(int row, int column, double value)
  {
    if (!sparse_) {
      out_.hessian(row, column) += value;
    } else if (row >= column) {
      second_.emplace_back(row, column, value);
    }
  }

  const PositionMap& map_of_j(const ElementPair& pair, const PairWork& work) const
  {
    return work.shifted ? work.image : maps_[pair.j];
  }

  /// True where two bodies are known to be out of range. Else `near` says where they may be in it.
  bool known_to_be_far(const KnownGap& known, double lost, NearPanels& near) const
  {
    std::vector<Panel> panels;
    for (const KnownPanel& p : known.panels) {
      // Gaps are beyond the model's clearance, the barrier's range is that of the settings.
      if (p.gap - lost + m_.clearance >= settings_.g_hat + settings_.clearance) {
        if (panels.empty()) return true;
        break;
      }
      if (panels.size() == most_near) return false;
      panels.push_back(p.s);
    }
    near = NearPanels(std::move(panels));
    return false;
  }

  void evaluate_side(int p, int f, const Pose& pp, const Pose& pf, const PairSide& side,
                     const NearPanels& near, PairWork& work) const
  {
    const PairFrame frame(m_.bodies[p], pp, m_.bodies[f], pf);
    work.sides.push_back(
        {p, f, side.swapped, frame.M, side_terms(frame, settings_, request_, side.share, near)});
    const SideTerms& t = work.sides.back().terms;
    if (t.energy == 0.0 || request_.order < 1) return;
    hauberk::add_side(to_world(t, frame.M, pp.position - pf.position, request_.order), side.swapped,
                      request_.order, work.sum);
  }

  bool add_side(const ElementPair& pair, const EvaluatedSide& side, const PositionMap& mj)
  {
    const SideTerms& t = side.terms;
    out_.evaluations += t.evaluations;
    out_.min_gap = std::min(out_.min_gap, t.min_gap);
    out_.regularity = std::min(out_.regularity, t.regularity);
    if (t.energy == 0.0) return false;
    out_.energy += t.energy;
    if (!request_.parameters && !request_.points) return true;
    const std::size_t i = pair.i, j = pair.j;
    const Pose pi{maps_[i].x, s_.rotation[i]}, pj{mj.x, s_.rotation[j]};
    const Pose &pp = side.swapped ? pj : pi, &pf = side.swapped ? pi : pj;
    if (request_.parameters) add_parameters(side.p, side.f, side.M, pp, pf, t);
    if (request_.points) {
      const Body& F = m_.bodies[side.f];
      for (ContactPoint c : t.points) {
        const Vec3 origin = pf.position + pf.rotation * F.center;
        c.on_p = origin + side.M * c.on_p;
        c.on_f = origin + side.M * c.on_f;
        c.normal = -(side.M * c.normal);  // from P to F
        ContactEnergy::Point q;
        q.image = pair.image;
        q.contact = c;
        q.a = side.p;
        q.b = side.f;
        if (side.swapped) {
          std::swap(q.a, q.b);
          std::swap(q.contact.on_p, q.contact.on_f);
          q.contact.normal = -q.contact.normal;
        }
        out_.points.push_back(q);
      }
    }
    return true;
  }

  /// Chain rule from (x_A - x_B, w_A, w_B) to the unknowns, through the load case's position maps.
  void scatter(const ElementPair& pair, const PositionMap& A, const PositionMap& B, const PairTerms& t)
  {
    const int nm = m_.macro_count, nc = m_.coordinate_count;
    const int n = nm + 2 * nc + 6;
    // x_A - x_B depends on the unknowns before the rotations, which are themselves.
    const int places = nm + 2 * nc;
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, most_local> C(3, places);
    std::array<int, most_local> index{};
    const auto at = [&index](int k) -> int& { return index[k]; };
    for (int k = 0; k < nm; ++k) at(k) = k;
    for (int k = 0; k < nc; ++k) {
      at(nm + k) = m_.offset(pair.i) + k;
      at(nm + nc + k) = m_.offset(pair.j) + k;
    }
    for (int k = 0; k < 3; ++k) {
      at(nm + 2 * nc + k) = m_.offset(pair.i) + nc + k;
      at(nm + 2 * nc + 3 + k) = m_.offset(pair.j) + nc + k;
    }
    C.leftCols(nm) = A.J.leftCols(nm) - B.J.leftCols(nm);
    C.middleCols(nm, nc) = A.J.middleCols(nm, nc);
    C.middleCols(nm + nc, nc) = -B.J.middleCols(nm, nc);

    for (int k = 0; k < places; ++k) out_.gradient[at(k)] += C.col(k).dot(t.gradient.head<3>());
    for (int k = 0; k < 6; ++k) out_.gradient[at(places + k)] += t.gradient[3 + k];
    if (request_.order < 2) return;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_local, most_local> H(n, n);
    // Coefficient by coefficient: of so small products blocks and their packing cost more.
    const auto TC = t.hessian.leftCols<3>().lazyProduct(C).eval();
    H.topLeftCorner(places, places) = C.transpose().lazyProduct(TC.topRows<3>());
    H.bottomLeftCorner(6, places) = TC.bottomRows<6>();
    H.topRightCorner(places, 6) = C.transpose().lazyProduct(t.hessian.topRightCorner<3, 6>());
    H.bottomRightCorner<6, 6>() = t.hessian.bottomRightCorner<6, 6>();
    if (A.curved || B.curved) add_curvature(A, B, t.gradient.head<3>(), H);
    for (int c = 0; c < n; ++c) {
      for (int r = 0; r < n; ++r) add_second(at(r), at(c), H(r, c));
    }
  }

  /// gradient . second derivatives of the positions.
  template <typename Local>
  void add_curvature(const PositionMap& A, const PositionMap& B, const Vec3& g, Local& H) const
  {
    const int nm = m_.macro_count, nc = m_.coordinate_count;
    for (int r = 0; r < nm + nc; ++r) {
      for (int c = 0; c < nm + nc; ++c) {
        double ha = 0.0, hb = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t rr = r, cc = c;
          if (A.curved) ha += g[k] * A.H[k][rr][cc];
          if (B.curved) hb -= g[k] * B.H[k][rr][cc];
        }
        H(r, c) += ha;
        H(r < nm ? r : r + nc, c < nm ? c : c + nc) += hb;
      }
    }
  }

  /// Chain rule to element parameters.
  void add_parameters(int p, int f, const Mat3& M, const Pose& pp, const Pose& pf, const SideTerms& t)
  {
    out_.d_clearance += t.d_clearance;
    const auto add = [&](int body, const std::vector<double>& by_geometry) {
      const Vector gradient = parameter_gradient(m_, body, by_geometry);
      out_.parameters.col(m_.bodies[body].element).head(gradient.size()) += gradient;
    };
    const GeometryTerms geometry = geometry_terms(t, M, m_.bodies[p], pp, m_.bodies[f], pf);
    add(p, geometry.P);
    add(f, geometry.F);
  }

  const Model& m_;
  const State& s_;
  const ContactSettings& settings_;
  const Request& request_;
  const GapBounds* bounds_;
  NearPanels everywhere_;
  std::vector<PositionMap> maps_;
  bool sparse_;
  ContactEnergy out_;
  std::vector<Eigen::Triplet<double>> second_;  ///< of a sparse Hessian
};

}  // namespace

ContactEnergy contact_energy(const Model& model, const State& state, const std::vector<ElementPair>& pairs,
                             const ContactSettings& settings, const Request& request, const GapBounds* bounds)
{
  // The published energy and that of meshes are not those of the surfaces' gaps.
  const bool surfaces = traits(settings.formulation).is_of_gaps;
  Assembler a(model, state, settings, request, surfaces ? bounds : nullptr);
  // Threads evaluate, one adds, in the order of the pairs: the result is the same to the last bit.
  const bool together = settings.threads > 1 && pairs.size() >= worth_threads;
  std::vector<PairWork> work(together ? std::min(pairs.size(), most_at_once) : 1);
  for (std::size_t first = 0; first < pairs.size(); first += work.size()) {
    if (settings.keep_going != nullptr && !(*settings.keep_going)()) throw Interrupted();
    const std::size_t count = std::min(work.size(), pairs.size() - first);
    if (together) {
      parallel_for(count, settings.threads, [&](std::size_t k) { a.evaluate(pairs[first + k], work[k]); });
    } else {
      a.evaluate(pairs[first], work[0]);
    }
    for (std::size_t k = 0; k < count; ++k) a.add(pairs[first + k], work[k]);
  }
  a.add_walls();
  return a.take();
}

}  // namespace hauberk
