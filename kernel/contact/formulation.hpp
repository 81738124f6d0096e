#pragma once
/// The contact formulations: barrier energy of one pair of bodies.

#include "contact/side_terms.hpp"
#include "geometry/panel_field.hpp"
#include "numerics/interrupted.hpp"

#include <functional>

namespace hauberk {

enum class Formulation {
  nearest,    ///< a barrier of every local minimum of the distance: add_nearest
  arc,        ///< the barrier integrated over curves or surfaces: add_arc, add_ribbon
  published,  ///< a barrier of squared gaps of local minima, faded where they merge: add_published
  mesh        ///< a barrier of every pair of features of triangle meshes: add_mesh (mesh.hpp)
};
/// The last of them: no number above it is one.
inline constexpr Formulation last_formulation = Formulation::mesh;

/// What others than the formulation itself have to know of it.
struct FormulationTraits {
  const char* name;  ///< in experiment files and results
  /// Over lines or surfaces: its energy has an error of quadrature, and listed forces are resultants.
  bool is_integral;
  /// A barrier of the gaps of exact surfaces and of nothing else: forces push along gaps, panels out of reach
  /// are left out, and what is known of gaps serves the next step.
  bool is_of_gaps;
  bool fades;         ///< contacts near a merge push through their fade, too
  bool is_of_meshes;  ///< of triangles that stand for surfaces
};

constexpr FormulationTraits traits(Formulation f)
{
  switch (f) {
    case Formulation::nearest:
      return {
          .name = "nearest", .is_integral = false, .is_of_gaps = true, .fades = false, .is_of_meshes = false};
    case Formulation::arc:
      return {.name = "arc", .is_integral = true, .is_of_gaps = true, .fades = false, .is_of_meshes = false};
    case Formulation::published:
      return {.name = "published",
              .is_integral = false,
              .is_of_gaps = false,
              .fades = true,
              .is_of_meshes = false};
    case Formulation::mesh:
      break;
  }
  return {.name = "mesh", .is_integral = false, .is_of_gaps = false, .fades = false, .is_of_meshes = true};
}

inline const char* name_of(Formulation f) { return traits(f).name; }

/// How local minima of the distance are found: none missed, or from samples as published (`published` only).
enum class MinimaSearch { certified, sampled };

/// How accurately `arc` integrates, in parts of the energy (tests/accuracy/quadrature_test.cpp): along lines
/// `fine` to 1e-11 and `rough` to 1e-7; over surfaces `fine` mostly to 1e-7 and at worst to 5e-5, `rough` to
/// 2e-4 and 1e-2. Rough costs three quarters and a fifth, for stages wider than 3e-4 L.
enum class Quadrature { fine, rough };

/// What an `arc` is integrated over. Of two equals `both`, half each, so that labels do not matter; or `one`,
/// the smaller ring (of two as large the first), at half the cost. `ribbon`: one of them, and of a flat tube
/// the line of those places of its cross-sections that are nearest to the other body, instead of its surface:
/// a tenth of the cost. Where a cross-section has two nearest places a ribbon jumps, and knows of one of
/// them.
enum class Sides { both, one, ribbon };

/// Activation distance and clearance, scaled by L.
struct ContactSettings {
  Formulation formulation = Formulation::arc;
  double g_hat = 0.05;
  double clearance = 0.0;
  MinimaSearch search = MinimaSearch::certified;
  /// Of `arc`: half-width of a panel over the distance to the integrand's nearest complex singularity. With
  /// y = 1/ratio the error of n-point Gauss falls like (y + sqrt(y^2 - 1))^(-2n): 5e-11 for n = 9 on lines,
  /// 1e-8 for n = 7 on surfaces (rough: 1e-7 for n = 6, 4e-4 for n = 3) at the default, as far as the gap is
  /// quadratic over a panel; smaller ratios serve to measure it.
  double panel_ratio = 0.5;
  Quadrature quadrature = Quadrature::fine;
  Sides sides = Sides::both;
  unsigned threads = 1;  ///< that evaluate pairs of a large scene; never changes a result
  /// Asked between pairs, and now and then within one, which may take many evaluations; where it says no,
  /// Interrupted is thrown. Null: never. Thread safe.
  const std::function<bool()>* keep_going = nullptr;
};

/// Throws ComputationError: what is sought between two bodies takes more evaluations than any pair is worth.
[[noreturn]] void too_flat(const PairFrame& frame, const char* what, long evaluations);

/// Sum of the clamped log barrier over every local minimum of the distance with gap < g_hat (paper eq. (4),
/// in the gap instead of its square), derivatives by the implicit-function theorem:
///   D_q = d_q,   D_qq = d_qq - d_qc H^-1 d_cq,   H = d_cc at the minimum.
/// F's coordinates are eliminated in closed form by its field; c is what remains of P. Gaps below g_hat are
/// in `near`.
template <int dim>
void add_nearest(const PairFrame& frame, const ContactSettings& settings, const Request& request,
                 const NearPanels& near, SideTerms& out);

/// Integral of the barrier over P (its core circle when P is a tube, else its surface), weight `share`.
/// Panels are halved until their half-widths are at most about half of sqrt(2 g/g''), the distance to the
/// nearest complex singularity of the integrand, with the gap g and its second derivative along u and v.
/// Gaps below g_hat are in `near`.
template <int dim>
void add_arc(const PairFrame& frame, const ContactSettings& settings, const Request& request, double share,
             const NearPanels& near, SideTerms& out);

/// Integral of the barrier of dimension 1 along the ribbon of P, a flat tube: over u the gap's least value
/// around its cross-section, found by Newton's method from where the cross-section faces F. Derivatives
/// follow as those of minima do: D_q = d_q, D_qq = d_qq - d_qv d_vq/d_vv. Needs has_strips(frame). Gaps below
/// g_hat are in `near`.
void add_ribbon(const PairFrame& frame, const ContactSettings& settings, const Request& request, double share,
                const NearPanels& near, SideTerms& out);

/// The published contact: the barrier of the squared gap of every local minimum, faded where the minimum is
/// about to merge with another or to vanish (paper equations (4) and (9) to (11)); see published.hpp. In
/// units of d_hat^2 = g_hat^4. `dim` says which probe set of P finds the minima.
template <int dim>
void add_published(const PairFrame& frame, const ContactSettings& settings, const Request& request,
                   SideTerms& out);

/// A local minimum of the distance of P's probe set to F.
struct Minimum {
  double u = 0.0, v = 0.0;
  double distance = 0.0;  ///< surface distance, no clearance
  bool flat = false;      ///< no curvature: one of many places with this distance, along a circle or a face
};

/// All local minima with surface distance below `threshold`, which are in `near`.
///
/// A panel is dropped when its bound exceeds the threshold, or when the gradient at its centre exceeds what
/// the bound of the second derivatives lets it change: then it holds no stationary point. What remains is
/// split until the sign of the second derivative is certain (dimension 1), or until a Newton iteration from
/// the centre decides (dimension 2). Throws ComputationError where that takes more than 2e7 evaluations, and
/// Interrupted where `keep_going`, if not null, says no.
template <int dim>
std::vector<Minimum> local_minima(const PairFrame& frame, double threshold, int& evaluations,
                                  const NearPanels& near = {},
                                  const std::function<bool()>* keep_going = nullptr);

}  // namespace hauberk
