#include "limits/symmetry.hpp"

#include "limits/body_images.hpp"
#include "limits/orthogonal_parts.hpp"
#include "limits/place_index.hpp"
#include "numerics/decompositions.hpp"

#include <algorithm>
#include <cmath>

namespace hauberk {
namespace {

/// Orthogonal parts closer than this are one.
constexpr double same_part = 1e-6;

/// The scene as the search for symmetries needs it.
class SymmetrySearch {
 public:
  explicit SymmetrySearch(const Model& model) : m_(model), places_(model), kinds_(element_kinds(model))
  {
    choose_rarest();
  }

  /// Orthogonal parts that are worth trying, the identity first.
  std::vector<Mat3> candidates() const
  {
    if (m_.element_count() == 0) return {Mat3::Identity()};
    std::vector<Mat3> out = m_.lattice.empty() ? patch_candidates(m_, kinds_) : lattice_point_group(m_);
    std::erase_if(out, [this](const Mat3& O) { return !load_allows(O); });
    return out;
  }

  /// Symmetries with this orthogonal part, at most `most`: the rarest element goes to each of its kind.
  std::vector<SceneSymmetry> with_part(const Mat3& O, std::size_t most) const
  {
    std::vector<SceneSymmetry> found;
    if (rarest_.empty() || O == Mat3::Identity()) found.push_back(identity());
    if (m_.lattice.empty()) {
      if (found.empty()) {
        if (std::optional<SceneSymmetry> g = symmetry(O, patch_translation(O)))
          found.push_back(std::move(*g));
      }
      return found;
    }
    for (const int j : rarest_) {
      if (found.size() >= most) break;
      if (O == Mat3::Identity() && j == rarest_.front()) continue;
      const Vec3 t = place(j) - O * place(rarest_.front());
      if (m_.load->bends() && leaves_lattice(t)) continue;
      if (std::optional<SceneSymmetry> g = symmetry(O, t)) found.push_back(std::move(*g));
    }
    return found;
  }

  SceneSymmetry identity() const
  {
    SceneSymmetry g;
    for (int i = 0; i < m_.element_count(); ++i) g.to.push_back(i);
    g.image.resize(m_.rest.size());
    g.local.assign(m_.rest.size(), Mat3::Identity());
    return g;
  }

 private:
  const Vec3& place(int i) const { return m_.rest[i].position; }

  /// Whether a translation has a part across the lattice's vectors: what bends is displaced along them alone.
  bool leaves_lattice(const Vec3& t) const
  {
    Eigen::Matrix3Xd T(3, static_cast<Eigen::Index>(m_.lattice.size()));
    for (std::size_t k = 0; k < m_.lattice.size(); ++k) T.col(k) = m_.lattice[k];
    return Vec3(t - T * least_squares(T, t)).norm() > symmetry_tolerance(t);
  }

  bool load_allows(const Mat3& O) const
  {
    const std::vector<double> macro(m_.macro_count, 0.0);
    std::vector<double> out(macro);
    return m_.load->transform(O, macro, out);
  }

  /// Elements of the kind that there are the fewest of, and the order in which elements are looked at: rare
  /// ones first, so that a wrong guess shows at once where one element in a large scene is not as the others.
  void choose_rarest()
  {
    std::vector<std::vector<int>> by_kind;
    for (int i = 0; i < m_.element_count(); ++i) {
      const auto kind = static_cast<std::size_t>(kinds_[i]);
      if (kind >= by_kind.size()) by_kind.resize(kind + 1);
      by_kind[kind].push_back(i);
    }
    std::stable_sort(by_kind.begin(), by_kind.end(),
                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (!by_kind.empty()) rarest_ = by_kind.front();
    for (const std::vector<int>& elements : by_kind) {
      for (const int i : elements) order_.push_back(static_cast<std::size_t>(i));
    }
  }

  /// What turns upside down swaps the highest and the lowest element.
  Vec3 patch_translation(const Mat3& O) const
  {
    if (O(2, 2) > 0.0) return Vec3::Zero();
    double lo = place(0).z(), hi = lo;
    for (const Pose& p : m_.rest) {
      lo = std::min(lo, p.position.z());
      hi = std::max(hi, p.position.z());
    }
    return {0.0, 0.0, lo + hi};
  }

  /// The symmetry x -> O x + t, if it is one.
  std::optional<SceneSymmetry> symmetry(const Mat3& O, const Vec3& t) const
  {
    const auto n = m_.rest.size();
    SceneSymmetry g;
    g.O = O;
    g.t = t;
    std::vector<bool> taken(n, false);
    std::vector<Placed> there;
    g.to.resize(n);
    g.image.resize(n);
    g.local.resize(n);
    for (const std::size_t i : order_) {
      places_.find(O * m_.rest[i].position + t, there);
      const auto goes_to = [&](const Placed& p) {
        const std::size_t j = p.element;
        return !taken[j] && kinds_[i] == kinds_[j] &&
               carries_bodies(m_, static_cast<int>(i), p.element, local(O, i, j), turns_);
      };
      const auto at = std::find_if(there.begin(), there.end(), goes_to);
      if (at == there.end()) return std::nullopt;
      const std::size_t j = at->element;
      taken[j] = true;
      g.to[i] = at->element;
      g.image[i] = at->image;
      g.local[i] = local(O, i, j);
    }
    return g;
  }

  Mat3 local(const Mat3& O, std::size_t i, std::size_t j) const
  {
    return m_.rest[j].rotation.transpose() * O * m_.rest[i].rotation;
  }

  const Model& m_;
  PlaceIndex places_;
  std::vector<int> kinds_;
  std::vector<int> rarest_;
  std::vector<std::size_t> order_;
  mutable SolidTurns turns_;
};

}  // namespace

std::vector<SceneSymmetry> point_symmetries(const Model& m)
{
  const SymmetrySearch search(m);
  std::vector<SceneSymmetry> out;
  for (const Mat3& O : search.candidates()) {
    const auto same = [&O](const SceneSymmetry& g) { return (g.O - O).norm() < same_part; };
    if (std::any_of(out.begin(), out.end(), same)) continue;
    for (SceneSymmetry& g : search.with_part(O, 1)) out.push_back(std::move(g));
  }
  return out;
}

std::vector<SceneSymmetry> scene_symmetries(const Model& m)
{
  const SymmetrySearch search(m);
  std::vector<SceneSymmetry> points = point_symmetries(m);
  // Translations are as many for every orthogonal part, so that those of the identity decide what is kept.
  const std::size_t each = std::max<std::size_t>(1, m.rest.size() * points.size());
  const std::size_t most = most_symmetric_elements / each;
  if (search.with_part(Mat3::Identity(), most + 1).size() > std::max<std::size_t>(1, most)) return points;
  std::vector<SceneSymmetry> out;
  for (const SceneSymmetry& point : points) {
    for (SceneSymmetry& g : search.with_part(point.O, most_symmetric_elements)) out.push_back(std::move(g));
  }
  return out;
}

}  // namespace hauberk
