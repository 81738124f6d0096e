#pragma once
/// Lengths as makers write them.

#include <string>

namespace hauberk::maker {

/// Millimetres of "8mm", "0.8 cm", "5/16in", "0.25in", "18awg" (American wire gauge, d = 0.127 mm * 92^((36 -
/// n)/39), ASTM B258) or "18swg" (British standard wire gauge, BS 3737). "0", "00", "000" are gauges, too:
/// 2/0, 3/0 as well. `option` is named in messages. Throws InputError where the unit is missing or the text
/// is no positive length.
double millimetres(const std::string& text, const std::string& option);

}  // namespace hauberk::maker
