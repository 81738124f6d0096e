#pragma once
/// The independent check of a results file: from the file alone, by brute force, with no code of the solver.

#include <hauberk/shape.hpp>
#include <hauberk/verify/fields.hpp>

#include <boost/json/value.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// What counts as equal. Lengths are multiples of the scene's characteristic length L.
struct VerifyTolerances {
  /// Of surface distances. Both the solver and the search here are exact to rounding, about 1e-15 L; a
  /// thousand times a thousand more leaves room for long sums, and still sees a pose 1e-3 mm off (second
  /// order: 1e-8 L).
  double gap = 1e-9;
  /// Of normals against the surfaces' own, radians. The closest points, hence normals, of a converged pair
  /// are good to the root of rounding.
  double normal = 1e-6;
  /// Largest admissible imbalance, over the norm of the load. Barrier forces at a gap g carry a relative
  /// rounding error of about 1e-15 L / g, 1e-5 at g = 1e-10 L, which is added, but no more than that much.
  double balance = 1e-4, rounding = 1e-15, most_rounding = 1e-3;
  /// Of the reported imbalance against the one found here: the same sum of the same numbers.
  double balance_agreement = 1e-8;
  /// Of gaps against the points that they are listed with, over the sizes of the coordinates.
  double written = 1e-13;
  /// How closely the smallest distance of a pair with a solid is to be enclosed; the search ends when its
  /// lower bound is that near to the smallest distance that it found.
  double enclosure = 1e-10;
  /// Of a solid's chart against its distance, over its radius: Newton's method leaves about 1e-14.
  double chart = 1e-9;
  /// Of what is held at zero, strains or curvatures times L; of reactions, beside ten times the imbalance.
  double held = 1e-9, reaction = 1e-7;
  /// Of the mean translation: one element in a thousand, moved by 1e-3 mm, shows.
  double translation = 1e-8;
  /// Of values that are functions of other values in the file.
  double value = 1e-11;
  /// How far a limit may lie on the wrong side of rest: rest may overlap by that much and count as touching.
  double wrong_side = 1e-9;
  /// `arc` spreads each force along a stretch of tube of which the file lists the resultant. Within a stretch
  /// of half-width w = sqrt(2 r g) the surfaces turn by w / r and bow by g: points are exact to that many
  /// gaps and normals to this many times sqrt(gap / L).
  double arc_gaps = 10.0;
  /// The wrench of that stretch and of its resultant differ by w^2 / r^2, a multiple of gap / L (up to 30 was
  /// seen).
  double arc_balance = 100.0;
};

/// One line of the report.
struct VerifyLine {
  bool ok = true;
  std::string text;     ///< without the leading PASS, FAIL or NONE
  bool checked = true;  ///< false: there was nothing to check
};

enum class VerifyOutcome : unsigned char { passed, failed, not_checked };

/// What the check says about one field: a number, a text, true, false or null, or a list or an object that is
/// empty.
struct VerifyField {
  std::string pointer;
  VerifyOutcome outcome = VerifyOutcome::not_checked;
  std::string why;  ///< where it is not checked
};

struct VerifyReport {
  bool ok = true;
  std::vector<VerifyLine> lines;
  std::vector<VerifyField> fields;  ///< all of the document, in its order
  /// A line each, "PASS ...", "FAIL ..." or "NONE ..." (nothing to check); then a line per reason for which
  /// fields are not checked, with their patterns; last how many fields passed, failed and are not checked.
  /// Each ended by a newline.
  std::string text() const;
};

/// Makes the primitives of a shape whose rule only its plugin knows: from `section`, the entry of the stored
/// experiment's `elements` that is called `type`, and parameters by name. Nothing where the shape cannot be
/// asked, with a sentence that says why in `why`: what depends on it is then not checked. Throws
/// std::exception for sections and parameters that the shape refuses, which fails the check.
using VerifyShapes = std::function<std::optional<std::vector<Primitive>>(
    const std::string& type, const boost::json::value& section,
    const std::map<std::string, double>& parameters, std::string& why)>;

/// Checks a document of format "hauberk-results/2": a line per limit (also those of a design's initial
/// scene), one for the profiles, one for the scene, one for the design. What is done about which field, and
/// why not, say the rules of fields.hpp.
///
/// For every limit with poses:
/// - smallest separation of surfaces of different elements and images, by exhaustive search, against min_gap
/// and
///   the clearance; nothing intersects;
/// - listed contacts: points on the two surfaces, normal unit and along the surfaces' normals, gap = distance
///   minus clearance, force >= 0;
/// - linking numbers of all pairs of core circles, image by image, equal at rest and at the limit;
/// - force balance: s t + sum_k f_k dg_k/dy = 0 for all unknowns y (in-plane strains, positions, rotations),
/// where
///   t = d value / d strain, s = +1 for stretch and -1 for compress (less strain/T where the
///   objective had a finite target T), normals point from the first element to
///   the second, so that the first is pushed by -f n and the second by +f n;
/// - value, companions and starts are what macro says; F is positive definite; the mean translation is
/// rest's;
///   heights keep to `out_of_plane`.
/// - a locked state is no saddle: no state nearby goes further (second-order condition, then an actual
/// motion);
/// - a locked bent state is a sheet on the scale of its elements, and one that is `not_a_sheet` is none.
///
/// `shapes` is asked for solids alone; without it scenes that have any are not checked.
///
/// Never throws for a bad document: what is missing or malformed is a failing line. Thread safe where
/// `shapes` is.
VerifyReport verify(const boost::json::value& results, const VerifyTolerances& tolerances = {},
                    const VerifyShapes& shapes = {});

}  // namespace hauberk
