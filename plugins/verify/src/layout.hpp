#pragma once
/// What an experiment's text says is in its cell, laid out anew: elements, their parameters and primitives.
#include "model.hpp"

#include <hauberk/verify/verify.hpp>

#include <boost/json/value.hpp>

#include <map>
#include <memory>
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

/// The primitives that the rule of an element's shape makes of parameters, or, where the rule is not known
/// here, its plugin, as far as they are solids; nothing for shapes that neither knows. `section` is the entry
/// of the experiment's `elements` that is called `type`. Throws Malformed where a parameter is missing or the
/// shape refuses it.
std::optional<std::vector<Primitive>> primitives_of(const std::string& type,
                                                    const boost::json::value& section,
                                                    const std::map<std::string, double>& parameters,
                                                    const std::string& where, const VerifyShapes& shapes);

/// The primitive's surface is that of a plugin.
void enter_solid(Primitive& into, std::shared_ptr<const Solid> solid);

/// What a shape that only its plugin knows makes of parameters, in the element frame; elsewhere than in
/// solids nothing that verify has rules for. Throws Unknown where it cannot be asked, Malformed where it
/// refuses.
std::vector<Primitive> plugin_primitives(const std::string& type, const boost::json::value& section,
                                         const std::map<std::string, double>& parameters,
                                         const std::string& where, const VerifyShapes& shapes);

/// A design variable as the experiment asks for it.
struct AskedVariable {
  std::string name;  ///< "k/ring.R", "type/ring.R" or "*/ring.R"; tied ones joined by =
  std::vector<std::pair<std::size_t, std::string>> parameters;  ///< of which elements
  double lower = 0.0, upper = 0.0;
};
std::vector<AskedVariable> asked_variables(const boost::json::value& design, const Layout& layout);

}  // namespace hauberk::verification
