#pragma once
/// How tightly a weave is wound onto a rod.

#include "maker/weave_sheet.hpp"

namespace hauberk::maker {

/// Least distance of a circle of radius R from a line along x at the height z. `axes`: of the circle, its
/// normal last.
double distance_from_axis(const Vec3& centre, const Mat3& axes, double R, double z);

/// Rolls along every way of the sheet, whose lattice at rest is given, that has a vector of it across, which
/// the rod is along: of strips of two rows of cells, three and more, until one more row changes both radii by
/// less than a hundredth, or strips close into tubes. Elements stay on the sheet, and slide along it.
/// Interrupted, it gives the ways that are done. Throws as `answer` does.
std::vector<RollAnswer> rolls(const Weave& weave, const Question& question, const std::vector<Vec3>& lattice,
                              const WeaveLookup& lookup, const std::shared_ptr<const Registry>& registry,
                              unsigned threads, Progress& progress);

/// As lines of a page for people, empty without rolls, and as a list for programs.
std::string rolls_text(const std::vector<RollAnswer>& rolls);
boost::json::array rolls_json(const std::vector<RollAnswer>& rolls);

}  // namespace hauberk::maker
