#pragma once
/// How elements move with the unknowns of the load cases. Unknowns, without unit: the macroscopic ones
/// (strains, or curvatures times L), then for each element a displacement u over L and a turn exp(w) about
/// its origin.
///
/// strain:     x = F (X + T) + u, u.z = 0 where z is fixed
/// solid:      x = F (X + T) + u
/// paraboloid: x = (X + u_x, Y + u_y, Z + A x^2 + B y^2 + C x y); the mean of u and sum of X x u are zero, or
/// all of u
///             where places are held
/// roll:       x = rolled(K, (X, Y, Z) + u), see roll.hpp, with u.z = 0 or, where elements may leave the
/// sheet, no
///             part of u.z that is a quadratic polynomial in X and Y; the rest as on a paraboloid
/// strip:      the same with K = k e_y e_y^T, and along x (1 + exx) (X + T) + u_x; the means of u_x and u_y
/// are zero,
///             or u_x and u_y where places are held, and of u.z what is quadratic in Y
#include "model.hpp"

#include <string>
#include <vector>

namespace hauberk::verification {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr Eigen::Index per_element = 6;

inline Eigen::Index macros(const Scene& scene)
{
  return scene.cell.size() == 3 ? 6 : scene.cell.size() == 1 ? 2 : 3;
}
/// Where the unknowns of an element begin.
inline Eigen::Index first_of(const Scene& scene, int element)
{
  return macros(scene) + per_element * element;
}
Eigen::Index unknowns(const Scene& scene);

/// Components of the macroscopic unknowns that a limit holds at zero, in the order of `hold`: a column of
/// coefficients each. With n = (c, s) along the load and m = (-s, c) across it they are n^T eps m (shear),
/// m^T eps m (lateral), and of H = [[2A, C], [C, 2B]] or K n^T H m (twist), m^T H m (transverse); `places` is
/// none of them. Throws Unknown.
struct HeldComponents {
  std::vector<std::string> names;
  Eigen::MatrixXd coefficients;
};
HeldComponents held_components(const Scene& scene, const Setting& setting);

/// Macroscopic unknowns without unit.
Macros scaled(const Macro& macro, double length);

/// Derivatives of an element's position (over L) by the macroscopic unknowns and by its own displacement.
struct PositionDerivatives {
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 6> macro;
  Mat3 own;
};
PositionDerivatives derivatives(const Scene& scene, const Setting& setting, const MovedState& state,
                                int element, const Image& image);

/// The state moved by the unknowns y.
MovedState moved(const Scene& scene, const Setting& setting, const MovedState& state, const Vector& y);

/// Orthonormal columns of what the load case holds: no motion has a part along them, and forces along them
/// are reactions.
Matrix held(const Scene& scene, const Setting& setting);

/// x without its part along the columns of `held`.
Vector free_part(const Matrix& held, const Vector& x);

/// Everything by which a state is not one of the load case's: positions off the paraboloid or the roll, a
/// mean or a turn that is held, elements that left held places. Lengths within `tolerance` (L).
std::vector<std::string> misplaced(const Scene& scene, const Setting& setting, const MovedState& state,
                                   double tolerance);

}  // namespace hauberk::verification
