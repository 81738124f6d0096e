#pragma once
/// The load of a limit, and whether listed forces balance it.

#include "kinematics.hpp"
#include "model.hpp"

namespace hauberk::verification {

/// Load t = d value / d macroscopic unknowns of a limit's measure and direction; throws Malformed when the
/// measure is not known. Along components d it is m d / |d| (component by component), |d|^2 = sum m_k d_k^2,
/// with m = (1, 1, 2) or (1, 1, 1, 2, 2, 2) for strains,
/// (1, 1, 1/2) for curvatures: those of the Frobenius norm.
Macros load(const Limit& limit);
/// Norm of components in the metric above.
double metric_norm(Load load, const Macros& components);
/// Value of a limit's measure at any state.
double value(const Limit& limit, const Macro& macro);
/// |F n| - 1.
double line_stretch(double direction_deg, const Macro& macro);

/// True for the senses in which the value grows.
bool is_positive(const Limit& limit);

/// What drives the macroscopic unknowns in a limit's state: s t, less macro/T where there is a finite target
/// T.
Macros driving_load(const Limit& limit, double length);

/// s t + sum_k f_k dg_k/dy, all of it: what no held component or place has taken yet.
Vector left_over(const Scene& scene, const Setting& setting, const Limit& limit);

/// r of each held component h_j: the least squares solution of left_over = s sum_j r_j dh_j/d macro.
Vector reactions(const Scene& scene, const Setting& setting, const Limit& limit);

/// Largest component of the imbalance driving_load + sum_k f_k dg_k/dy over the norm of t, without the part
/// that what the load case holds takes.
///
/// Unknowns y as in kinematics.hpp. With the gap's normal n from the first element (point P, origin x) to the
/// second (P', x'):
///   dg/du = -n . dx/du of the first, +n . dx'/du of the second;  dg/dw = -(P - x) x n of the first,
///   (P' - x') x n of the second;  dg/d macro = n . (dx' - dx)/d macro.
/// A wall with normal n = (0, 0, +-1) stands at a fixed distance from the mean height of all elements, hence
/// takes part as the second body with 1/N of every element. z carries no equation where it is fixed.
double imbalance(const Scene& scene, const Setting& setting, const Limit& limit);

}  // namespace hauberk::verification
