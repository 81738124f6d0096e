#pragma once
/// From results to the scenes and limits that are checked.

#include "model.hpp"

#include <hauberk/verify/verify.hpp>

#include <boost/json/value.hpp>

namespace hauberk::verification {

/// Where the surfaces of solids come from: shapes of the experiment's elements.
struct ShapeSource {
  const boost::json::value& experiment;
  std::string where;  ///< of the experiment
  const VerifyShapes& shapes;
};

/// Readers of parts of a results document. `where` is the JSON pointer of the part, for messages; all throw
/// Malformed. A scene with solids whose shape cannot be asked throws Unknown.
Scene read_scene(const boost::json::value& scene, const std::string& where, const ShapeSource& source);
Limit read_limit(const boost::json::value& limit, Load load, const std::string& where);
/// Throws Unknown for a load case that is not known here.
Setting read_setting(const boost::json::value& experiment);

/// Throws Malformed unless L is the median of the scene's ring radii (of an even number the upper of the two
/// middle ones); tolerances are multiples of L, so it must not be invented.
void check_length(const Scene& scene, double length, const std::string& where);

/// Member `key` of an object; throws Malformed when there is none.
const boost::json::value& member(const boost::json::value& object, const char* key, const std::string& where);
double number(const boost::json::value& v, const std::string& where);
/// Null (or a missing member) is no value.
std::optional<double> optional_number(const boost::json::value& object, const char* key,
                                      const std::string& where);
std::string text(const boost::json::value& v, const std::string& where);
const boost::json::array& array(const boost::json::value& v, const std::string& where);

}  // namespace hauberk::verification
