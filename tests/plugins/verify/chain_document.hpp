#pragma once
#include <boost/json/object.hpp>
#include <boost/json/value.hpp>

#include <string>

namespace hauberk::test {

/// A chain of two perpendicular linked rings A and B, stretched until the tubes are `gap` + `clearance`
/// apart.
///
/// A lies in the plane at the origin, B is turned by 90 degrees about the chain. The right inner side of A
/// touches the left inner side of B's image (0, 0), and the left one the right side of B's image (-1, 0), so
/// the period is 2 (R_A + R_B - r_A - r_B - clearance - gap) and each contact carries 1 / (rest period).
struct Chain {
  double R_a = 5.0, r_a = 0.7, R_b = 5.0, r_b = 0.7;
  double axial = 0.0;  ///< r1 of both tubes; 0: circular
  double gap = 1e-11;
  double clearance = 0.0;
  double turned_deg = 0.0;  ///< scene and load together
  /// The load of "equation_12" is that of a chain along an axis only; in between it asks for other shear
  /// forces.
  std::string measure = "tensor";
};

inline constexpr double rest_period = 12.0;

/// A complete, true results document of one limit.
boost::json::value chain_document(const Chain& chain = {});

/// An entry of an experiment's `elements`: one torus named ring.
boost::json::object torus_element(double R, double r0, double r1);
/// An entry of its `place`, where `rest` says.
boost::json::object placed_element(const std::string& type, const boost::json::object& rest);

/// The one line about the limit.
std::string limit_line(const boost::json::value& document);

}  // namespace hauberk::test
