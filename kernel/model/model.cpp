#include "model/model.hpp"

#include "geometry/closed_curve.hpp"
#include "geometry/facets.hpp"
#include "model/links.hpp"
#include "numerics/decompositions.hpp"

#include <hauberk/error.hpp>
#include <hauberk/solid.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace hauberk {
namespace {

/// Orthonormal columns that span the translations of link cycles.
Eigen::Matrix<double, 3, Eigen::Dynamic> linked_space(const Model& m)
{
  constexpr double independent = 1e-9;  // of the longest translation
  const std::vector<Vec3> cycles = cycle_translations(m);
  Eigen::Matrix<double, 3, Eigen::Dynamic> columns(3, static_cast<Eigen::Index>(cycles.size()));
  for (std::size_t k = 0; k < cycles.size(); ++k) columns.col(k) = cycles[k];
  if (cycles.empty()) return columns;
  return orthonormal_span(columns, independent);
}

/// How far, along each lattice vector, elements that hold each other may be apart: half the vector where
/// chains of links run along it. An idle vector keeps copies apart that nothing joins, and its length says
/// nothing: no more than the longest reach of an element counts.
std::vector<double> lattice_distances(const Model& m)
{
  constexpr double aside = 1e-9;  // part of a vector outside of the span
  const Eigen::Matrix<double, 3, Eigen::Dynamic> space = linked_space(m);
  const double reach = m.reach.empty() ? 0.0 : *std::max_element(m.reach.begin(), m.reach.end());
  std::vector<double> out;
  for (const Vec3& t : m.lattice) {
    const Vec3 within = space.cols() == 0 ? Vec3::Zero() : Vec3(space * (space.transpose() * t));
    const bool idle = (t - within).norm() > aside * t.norm();
    out.push_back(idle ? std::min(0.5 * t.norm(), reach) : 0.5 * t.norm());
  }
  return out;
}

/// Mean squared displacement of elements against each other for a unit of a macroscopic unknown: |X|^2 for a
/// strain, |X|^4 for a curvature.
double squared_displacement(const std::vector<double>& distances, const MacroInfo& macro)
{
  double sum = 0.0;
  for (const double d : distances) sum += std::pow(d, 2.0 * (1.0 - macro.length_power));
  return std::max(1.0, sum / static_cast<double>(std::max<std::size_t>(1, distances.size())));
}

/// Images of one pair that are looked at at rest. More are no fabric but a slip in a length.
constexpr double most_images_at_rest = 1e4;

/// Lattice translations to either side that may bring a pair within its reach.
class ImageRange {
 public:
  explicit ImageRange(const Model& m) : vectors_(m.lattice.size())
  {
    Eigen::Matrix<double, 3, Eigen::Dynamic> T(3, static_cast<Eigen::Index>(vectors_));
    for (std::size_t k = 0; k < vectors_; ++k) T.col(k) = m.lattice[k];
    const Matrix inverse = reciprocal_basis(T);
    for (std::size_t k = 0; k < vectors_; ++k) reciprocal_[k] = inverse.row(k).norm();
  }

  /// Whether the translations k T1 + l T2 (+ m T3) that are at most `far` long, which have |k| <= |b1| far
  /// with b1 the reciprocal vector, are at most `most`.
  bool within(double far, double most) const
  {
    double images = 1.0;
    for (std::size_t k = 0; k < vectors_; ++k) images *= 2.0 * std::floor(far * reciprocal_[k]) + 1.0;
    return images <= most;
  }

 private:
  std::size_t vectors_;
  std::array<double, 3> reciprocal_{};
};

/// Refuses scenes whose images would take forever to look at.
void check_images(const Model& m)
{
  if (m.lattice.empty() || m.rest.empty()) return;
  const ImageRange range(m);
  Eigen::AlignedBox3d box;
  for (const Pose& p : m.rest) box.extend(p.position);
  const double furthest = *std::max_element(m.reach.begin(), m.reach.end());
  // All pairs at once, before each on its own.
  if (range.within(box.diagonal().norm() + 2.0 * furthest + m.clearance, most_images_at_rest)) return;
  for (std::size_t i = 0; i < m.rest.size(); ++i) {
    for (std::size_t j = i; j < m.rest.size(); ++j) {
      const double far =
          (m.rest[i].position - m.rest[j].position).norm() + m.reach[i] + m.reach[j] + m.clearance;
      if (range.within(far, most_images_at_rest)) continue;
      throw InputError(fmt::format(
          "elements {} and {}: more than {:g} images of the cell are within their reach: its vectors are far "
          "shorter than the elements, or an element is far away from the cell; correct cell.vectors, "
          "positions, radii or solver.clearance",
          i, j, most_images_at_rest));
    }
  }
}

void set_metric(Model& m)
{
  m.metric = Vector::Ones(m.dofs());
  std::vector<double> weights(m.macro_count);
  m.load->metric(weights);
  std::vector<double> distances = lattice_distances(m);
  if (m.load->bends()) {
    for (const Pose& p : m.rest) distances.push_back(p.position.norm());
  }
  for (int k = 0; k < m.macro_count; ++k) {
    const std::size_t i = k;
    m.metric[k] = squared_displacement(distances, m.load->macros()[i]) * weights[i];
  }
  for (int i = 0; i < m.element_count(); ++i) {
    const double r = m.reach[i];
    m.metric.segment<3>(m.offset(i) + m.coordinate_count).setConstant(r * r);
  }
}

/// Orthonormal columns that span the equalities' coefficients.
Matrix held_directions(const Model& m, const std::vector<LinearEquality>& equalities)
{
  Matrix rows = Matrix::Zero(m.dofs(), static_cast<int>(equalities.size()));
  for (int k = 0; k < rows.cols(); ++k) {
    for (const LinearTerm& t : equalities[k].terms)
      rows(m.offset(t.element) + t.coordinate, k) += t.coefficient;
  }
  if (rows.cols() == 0) return rows;
  Matrix span = orthonormal_span(rows);
  if (span.cols() < rows.cols()) {
    throw InputError(
        "the conditions that hold this patch in its place depend on each other: a patch needs at least two "
        "elements at different places");
  }
  return span;
}

}  // namespace

namespace {

void set_linked(Model& m)
{
  std::set<std::tuple<int, int, Image>> pairs;
  for (const ElementLink& link : element_links(m)) {
    const auto& [i, j, image] = link.pair;
    const Image back{-image[0], -image[1], -image[2]};
    if (i < j) pairs.insert({i, j, image});
    if (i > j) pairs.insert({j, i, back});
    if (i == j) pairs.insert({i, j, std::max(image, back)});
  }
  for (const auto& [i, j, image] : pairs) {
    m.linked.push_back({i, j});
    m.linked_translations.push_back(m.translation(image));
  }
}

std::shared_ptr<const Facets> facets_of(const Body& b, int count)
{
  if (b.solid) return std::make_shared<const Facets>(*b.solid, b.unit, count);
  if (b.surface) return std::make_shared<const Facets>(*b.surface, b.R);
  if (b.curve) return std::make_shared<const Facets>(*b.curve, b.r0, count);
  return std::make_shared<const Facets>(b.R, b.r0, b.r1, count);
}

/// All that a body's mesh depends on.
std::vector<double> mesh_key(const Body& b)
{
  if (b.solid) return b.solid->sizes();
  std::vector<double> key{b.R, b.r0, b.r1};
  if (!b.curve) return key;
  for (const Harmonic& h : b.curve->harmonics()) {
    key.insert(key.end(), h.c.begin(), h.c.end());
    key.insert(key.end(), h.s.begin(), h.s.end());
  }
  return key;
}

/// Gives every body its mesh; bodies of one size and one curve, of one surface, or of one solid share one.
void set_facets(Model& m, int count)
{
  using Key = std::tuple<const TriangleSurface*, std::string, std::vector<double>>;
  std::map<Key, std::shared_ptr<const Facets>> made;
  for (Body& b : m.bodies) {
    std::shared_ptr<const Facets>& facets =
        made[{b.surface.get(), b.solid ? b.solid->kind() : "", mesh_key(b)}];
    if (!facets) facets = facets_of(b, count);
    b.facets = facets;
  }
}

/// Finds the spines of elements; equal elements share one. Where none has a loop beyond its primitives' cores
/// and meshes, cores are all there is and spines are not kept.
void set_spines(Model& m)
{
  std::map<std::pair<std::vector<std::string>, std::vector<double>>, std::shared_ptr<const Spine>> made;
  bool together = false;
  std::vector<std::shared_ptr<const Spine>> spines;
  const auto several = [](const SpineLoop& l) { return l.primitives.size() > 1; };
  if (m.bodies.size() == m.rest.size()) return;  // one primitive each
  for (std::size_t e = 0; e < m.rest.size(); ++e) {
    const std::size_t first = m.first_body[e], end = m.first_body[e + 1];
    std::vector<std::string> kinds;  // of solids: what their sizes mean
    std::vector<double> key;
    bool meshes = false;
    for (std::size_t k = first; k < end; ++k) {
      const Body& b = m.bodies[k];
      const std::vector<double> size = mesh_key(b);
      key.insert(key.end(), b.center.begin(), b.center.end());
      key.insert(key.end(), b.axes.reshaped().begin(), b.axes.reshaped().end());
      key.insert(key.end(), size.begin(), size.end());
      meshes = meshes || b.surface;
      kinds.push_back(b.solid ? b.solid->kind() : "");
      if (b.solid) key.insert(key.end(), b.solid->sizes().begin(), b.solid->sizes().end());
    }
    std::shared_ptr<const Spine> spine;
    if (const auto known = made.find({kinds, key}); known != made.end() && !meshes) spine = known->second;
    if (!spine) {
      spine = std::make_shared<const Spine>(make_spine(std::span(m.bodies).subspan(first, end - first)));
      if (!meshes) made[{kinds, key}] = spine;
    }
    together = together || std::any_of(spine->loops.begin(), spine->loops.end(), several);
    spines.push_back(std::move(spine));
  }
  if (!together) return;
  m.spines = std::move(spines);
  m.first_loop.assign(1, 0);
  for (const auto& s : m.spines)
    m.first_loop.push_back(m.first_loop.back() + static_cast<int>(s->loops.size()));
}

/// Nothing but contact of meshes knows where the surface of a triangle mesh is.
void refuse_surfaces(const Model& m)
{
  if (std::any_of(m.bodies.begin(), m.bodies.end(), [](const Body& b) { return b.surface != nullptr; }))
    throw InputError("this scene has elements that are triangle meshes: set solver.contact to \"mesh\"");
}

}  // namespace

Model make_model(const SceneSpec& spec, const LoadCase& load, double clearance)
{
  Model m;
  m.length = characteristic_length(spec);
  m.clearance = clearance / m.length;
  m.load = &load;
  m.macro_count = load.macro_count();
  m.coordinate_count = load.coordinate_count();
  for (const Vec3& t : spec.lattice) m.lattice.emplace_back(t / m.length);

  std::vector<Vec3> positions;
  const bool copies = copies_of_one_size(spec);
  for (std::size_t k = 0; k < spec.elements.size(); ++k) {
    const PlacedElement& e = spec.elements[k];
    const Shape& shape = *spec.types[e.type].shape;
    const std::vector<Primitive> primitives = shape.primitives(e.parameters);
    std::vector<PrimitiveJacobian> jacobians = shape.jacobians(e.parameters);
    m.first_body.push_back(static_cast<int>(m.bodies.size()));
    double reach = 0.0;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      m.bodies.push_back(make_body(primitives[i], static_cast<int>(k), static_cast<int>(i), m.length));
      m.jacobians.push_back(std::move(jacobians[i]));
      reach = std::max(reach, m.bodies.back().reach);
    }
    m.parameter_count.push_back(static_cast<int>(e.parameters.size()));
    m.reach.push_back(reach);
    m.source.push_back(copies && e.copy_of >= 0 ? e.copy_of : static_cast<int>(k));
    m.rest.push_back({e.rest.position / m.length, e.rest.rotation});
    positions.push_back(m.rest.back().position);
  }
  m.first_body.push_back(static_cast<int>(m.bodies.size()));
  if (spec.facets > 0) {
    set_facets(m, spec.facets);
  } else {
    refuse_surfaces(m);
  }
  check_images(m);
  m.walls = load.inequalities(positions);
  set_spines(m);
  m.links = find_links(m, rest_state(m));
  set_metric(m);
  m.held = held_directions(m, load.equalities(positions));
  if (load.bends()) set_linked(m);
  return m;
}

/// Where both cost about the same: share/doc/speed.md.
constexpr int most_dense = 250;

double Model::value_unit() const { return std::pow(length, load->value_length_power()); }

double Model::macro_unit(int k) const { return std::pow(length, load->macros()[k].length_power); }

bool Model::sparse() const { return dofs() > most_dense; }

std::vector<int> shown(const Image& image)
{
  std::vector<int> indices(image.begin(), image.end());
  if (image[2] == 0) indices.pop_back();
  return indices;
}

Vector parameter_gradient(const Model& m, int body, const std::vector<double>& geometry)
{
  const std::size_t k = body;
  Vector out = Vector::Zero(m.parameter_count[m.bodies[k].element]);
  for (std::size_t r = 0; r < geometry.size(); ++r) {
    for (int c = 0; c < out.size(); ++c)
      out[c] += geometry[r] * m.geometry_derivative(k, static_cast<int>(r), c);
  }
  return out;
}

State rest_state(const Model& m)
{
  State s;
  s.macro = Vector::Zero(m.macro_count);
  s.e = Vector::Zero(m.element_count() * m.coordinate_count);
  for (const Pose& p : m.rest) s.rotation.push_back(p.rotation);
  return s;
}

Pose image_pose(const Model& m, const State& s, int element, const Image& image)
{
  PositionMap map;
  const std::size_t k = element;
  m.load->position(s.macro_values(),
                   {s.e.data() + element * m.coordinate_count, static_cast<std::size_t>(m.coordinate_count)},
                   m.rest[k].position, m.translation(image), map);
  return {map.x, s.rotation[k]};
}

std::vector<Pose> poses(const Model& m, const State& s)
{
  std::vector<Pose> p;
  p.reserve(m.rest.size());
  for (int i = 0; i < m.element_count(); ++i) p.push_back(image_pose(m, s, i, {0, 0}));
  return p;
}

State advanced(const Model& m, const State& s, const Vector& dy, double alpha)
{
  State n = s;
  n.macro += alpha * dy.head(m.macro_count);
  for (int i = 0; i < m.element_count(); ++i) {
    const int o = m.offset(i);
    n.e.segment(i * m.coordinate_count, m.coordinate_count) += alpha * dy.segment(o, m.coordinate_count);
    auto& Q = n.rotation[i];
    Q = rotation_exp(alpha * dy.segment<3>(o + m.coordinate_count)) * Q;
  }
  return n;
}

Vector difference(const Model& m, const State& from, const State& to)
{
  Vector dy(m.dofs());
  dy.head(m.macro_count) = to.macro - from.macro;
  for (int i = 0; i < m.element_count(); ++i) {
    const int o = m.offset(i);
    dy.segment(o, m.coordinate_count) = to.e.segment(i * m.coordinate_count, m.coordinate_count) -
                                        from.e.segment(i * m.coordinate_count, m.coordinate_count);
    const std::size_t k = i;
    const Mat3 D = to.rotation[k] * from.rotation[k].transpose();
    // Small turns through the antisymmetric part: exact to rounding where angle-axis loses digits.
    const Vec3 a = 0.5 * Vec3(D(2, 1) - D(1, 2), D(0, 2) - D(2, 0), D(1, 0) - D(0, 1));
    const double s = a.norm(), c = 0.5 * (D.trace() - 1.0);
    const double angle = std::atan2(s, c);
    dy.segment<3>(o + m.coordinate_count) = s > 1e-150 ? Vec3(a * (angle / s)) : Vec3(a);
  }
  return dy;
}

std::string not_a_sheet(const Model& m, const State& s)
{
  if (!m.load->bends()) return {};
  std::vector<Vec3> X;
  X.reserve(m.rest.size());
  for (const Pose& p : m.rest) X.push_back(p.position);
  return m.load->not_a_sheet({s.macro_values(),
                              {s.e.data(), static_cast<std::size_t>(s.e.size())},
                              X,
                              m.reach,
                              m.linked,
                              m.linked_translations});
}

Vector free_part(const Model& m, const Vector& x)
{
  return m.held.cols() == 0 ? x : Vector(x - m.held * (m.held.transpose() * x));
}

double step_norm(const Model& m, const Vector& dy) { return std::sqrt(dy.cwiseAbs2().dot(m.metric)); }

double largest_motion(const Model& m, const Vector& dy)
{
  double most = 0.0;
  for (int i = 0; i < m.element_count(); ++i) {
    const int o = m.offset(i);
    most = std::max(most, dy.segment(o, m.coordinate_count).norm() +
                              dy.segment<3>(o + m.coordinate_count).norm() * m.reach[i]);
  }
  return most;
}

}  // namespace hauberk
