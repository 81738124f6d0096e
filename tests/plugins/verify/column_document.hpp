#pragma once
#include <boost/json/value.hpp>

namespace hauberk::test {

/// A column of two flat rings A and B (R 5, r 0.7) in a plane, pressed together along x: a results document
/// in which everything but this is in order.
///
/// The period is 2 * 2 (R + r) = 22.8, each of the two contacts carries 1 / (rest period). By symmetry the
/// forces balance, but B may move sideways: with B off by h the period is 2 sqrt(11.4^2 - h^2), so the column
/// goes on: a saddle.
///
boost::json::value column_document();

inline constexpr double column_rest_period = 25.0;

}  // namespace hauberk::test
