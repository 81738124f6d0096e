#pragma once
/// Results with solids, and the plugins that know their surfaces.

#include <hauberk/verify/verify.hpp>

#include <string>

namespace hauberk::test {

/// Asks the program's plugins, and the shape `solid_rings` of these tests.
VerifyShapes stored_shapes();

/// A chain of two kinds of rings that are solids: it locks at a period of 2 (5 + 4.6 - 1.4).
std::string solid_chain_text();

}  // namespace hauberk::test
