#pragma once
/// Derivatives against central differences at several steps.

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hauberk::conformance {

/// Component-wise: the function of s whose derivative at s = 0 is to be checked.
using Along = std::function<std::vector<double>(double s)>;

/// A wrong component of a derivative.
struct Deviation {
  std::size_t component;
  double claimed, difference;  ///< by the plugin; by the central difference of the smallest step
  double slope;                ///< of the error against the step; 2 where the derivative is right
};

/// Compares `claimed` with (f(h) - f(-h))/(2 h) for steps h = `largest` / 2^k. The error of central
/// differences is C h^2 + R/h, where R is the rounding of f: a component is right where its error reaches the
/// rounding, or falls with slope 2 where it does not. Returns the first that does neither. Throws what f
/// throws.
std::vector<Deviation> deviations(const Along& f, std::span<const double> claimed, double largest);

/// "the plugin says 1, central differences say 2 (their error falls with slope 0.0, not 2)".
std::string text_of(const Deviation& d);

}  // namespace hauberk::conformance
