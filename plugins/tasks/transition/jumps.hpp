#pragma once
/// Discontinuities of an energy and its force along a path, told apart from steep slopes.

#include "tasks/transition/evaluation.hpp"

#include <functional>

namespace hauberk {

/// What is known about the path: values and slopes at s.
using PathFunction = std::function<PathPoint(double s)>;

/// Energy, or gradient (scaled by L) with the norm of its six components.
enum class Quantity { energy, force };

/// Largest discontinuity and where, in absolute size.
struct Jump {
  double size = 0.0, at = 0.0;
  double resolution = 0.0;  ///< what a discontinuity elsewhere is smaller than
};

/// The largest discontinuity of `quantity` on [0, 1].
///
/// What a function f does between a and b beyond what its derivative says is
///
///   r = |f(b) - f(a) - (b - a)/6 (f'(a) + 4 f'((a + b)/2) + f'(b))|   (Simpson's rule).
///
/// Where f is smooth r falls with the fifth power of b - a, however steep f is; a discontinuity of f stays
/// whole. So the interval with the largest r is halved, again and again, from `intervals` equal ones on: a
/// discontinuity ends in an interval of width `narrowest`, and its r there is its size. The largest r of the
/// intervals left, at most `enough` or after `most_splits`, is the resolution: larger discontinuities would
/// have been followed (but for an r in which an error of Simpson's rule happens to cancel one). Thread safe
/// as `f` is; deterministic.
Jump largest_jump(const PathFunction& f, Quantity quantity, int intervals, int most_splits,
                  double enough = 0.0, double narrowest = 1e-9);

}  // namespace hauberk
