#pragma once
/// What an experiment's text says is in its cell, laid out anew: elements, their parameters and primitives.
#include "model.hpp"

#include <boost/json/value.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::verification {

struct LaidElement {
  std::string type;
  std::map<std::string, double> parameters;
  Place rest;
  int place = 0;  ///< its entry of the experiment's `place`
  int tile = 0;   ///< the element by which variables are named that it shares its parameters with
};

struct Layout {
  std::vector<Vec3> cell;  ///< the vectors of the repeated cell; none of a patch
  std::vector<LaidElement> elements;
};

/// Nothing where the experiment does not list what is in its cell (a weave that was not replaced by what it
/// stands for). Throws Malformed.
std::optional<Layout> laid_out(const boost::json::value& experiment);

/// The rotation that an experiment writes as axis and degrees, or as a quaternion; none where `v` is null.
/// Throws Malformed.
Mat3 read_turn(const boost::json::value* v, const std::string& where);

/// The primitives that the rule of an element's shape makes of parameters; nothing for shapes whose rule is
/// not known here. `section` is the entry of the experiment's `elements`. Throws Malformed where a parameter
/// is missing.
std::optional<std::vector<Primitive>> primitives_of(const boost::json::value& section,
                                                    const std::map<std::string, double>& parameters,
                                                    const std::string& where);

/// A design variable as the experiment asks for it.
struct AskedVariable {
  std::string name;  ///< "k/ring.R", "type/ring.R" or "*/ring.R"; tied ones joined by =
  std::vector<std::pair<std::size_t, std::string>> parameters;  ///< of which elements
  double lower = 0.0, upper = 0.0;
};
std::vector<AskedVariable> asked_variables(const boost::json::value& design, const Layout& layout);

}  // namespace hauberk::verification
