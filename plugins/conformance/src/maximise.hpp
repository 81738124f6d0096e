#pragma once
/// The worst case of a bound that is declared: drawing alone hardly ever meets it.

#include <functional>
#include <vector>

namespace hauberk::conformance {

/// A point from which no coordinate can be moved to make f larger, found from x: one coordinate after the
/// other is moved to and fro by its step, and steps are halved where nothing is gained (the exploratory moves
/// of Hooke and Jeeves, J. ACM 8 (1961) 212). Ends after `sweeps`. What is not a number counts as less than
/// any.
std::vector<double> maximise(const std::function<double(const std::vector<double>&)>& f,
                             std::vector<double> x, std::vector<double> step, int sweeps);

}  // namespace hauberk::conformance
