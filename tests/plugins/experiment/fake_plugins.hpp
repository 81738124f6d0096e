#pragma once
/// Plugins that live in the test program: a shape of rings, a load case in the plane and one that bends, an
/// optimizer. They know no mechanics; the experiment reader does not need any.

#include <hauberk/experiment/experiment.hpp>

#include <string>

namespace hauberk::test {

/// Finds "rings" (shape; list of rings, parameters <name>.R and <name>.r, .r below .R, no default for R),
/// "moved" (shape; parameter x), "placed" (shape; field position),
/// "plane" (load case; measure), "strains" (load case with exx, eyy, exy), "bend" (load case) and "search"
/// (optimizer; steps).
const PluginTable* fake_lookup(PluginKind kind, const std::string& id, std::string& error);

/// A correct experiment: task limits, two rings, plane.
std::string valid_text();

/// `text` with the first `from` replaced by `to`; fails the test when `from` is not there.
std::string with(std::string text, const std::string& from, const std::string& to);

/// All problems of `text`, as printed, for the file "t.json"; "" when it is correct.
std::string problems_of(const std::string& text, const std::vector<std::string>& overrides = {});

/// The experiment; fails the test when it is not correct.
Experiment read_ok(const std::string& text, const std::vector<std::string>& overrides = {});

}  // namespace hauberk::test
