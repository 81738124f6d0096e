#pragma once
/// A maker's answers about a weave of given rings: whether it can be woven, how far it gives, what it weighs.

#include "limits/limit_result.hpp"
#include "maker/weave_rings.hpp"
#include "run/progress.hpp"
#include "tasks/job.hpp"

#include <hauberk/host/registry.hpp>

#include <boost/json/object.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::maker {

/// One way of the sheet. Pitches, in mm, are how far the pattern repeats itself along the way.
struct WayAnswer {
  std::string name;
  double degrees = 0.0;
  double pitch = 0.0;                       ///< at rest
  std::optional<double> stretch, compress;  ///< of the length at rest; none where there is no locked state
  std::string stretch_status, compress_status;
  std::string stretch_confidence, compress_confidence;  ///< words of results
  /// Of a sheet in these states: strain across the way, and mm from the lowest to the highest point.
  std::optional<double> stretch_across, compress_across, stretch_thickness, compress_thickness;
};

/// A strip of the sheet, wound onto a rod: bent along the way.
struct RollAnswer {
  std::string name;
  double degrees = 0.0;
  int rows = 0;                    ///< cells beside each other, along the way
  double turns = 0.0;              ///< that they go around
  std::optional<double> up, down;  ///< smallest radius of the sheet's middle, mm; none without a locked state
  double up_rod = 0.0, down_rod = 0.0;  ///< diameter of the rod that there is room for then, mm; 0: of none
  std::string up_status, down_status;
  std::string up_confidence, down_confidence;
};

/// All answers.
struct Sheet {
  Question question;
  Weave weave;
  double ratio = 0.0;         ///< inner / wire, of two sizes of the large rings
  Fitting fitting;            ///< with which rings it can be woven
  double inner_of_gap = 0.0;  ///< of one size: with which it could be printed, this wire
  double largest_gap = 0.0;   ///< that there is room for
  bool chain = false;
  double thickness = 0.0;  ///< at rest, mm; 0 of a chain
  double rest_gap = 0.0;   ///< smallest distance of two rings' surfaces at rest, mm
  double rings = 0.0;      ///< of all sizes, per dm^2 at rest, per metre of a chain
  double metal = 0.0;      ///< volume of the wire of these, mm^3; 2 pi^2 R r^2 is that of a ring
  std::vector<WayAnswer> ways;
  std::vector<RollAnswer> rolls;    ///< none of a chain
  bool cut_short = false;           ///< rolls were interrupted: those that are missing were asked for
  bool printable = false;           ///< whether the weave has room for the gap
  std::vector<WayAnswer> with_gap;  ///< what the gap leaves; none where it has no room
  std::shared_ptr<const Job> job;   ///< that `ways` are of, solved: two limits of each, stretch first
};

/// Computes the answers to a question that fits. Limits are those of the load's direction with the shear
/// held, in the plane (of a chain free to leave it). Throws what preparing and computing an experiment
/// throws; InputError where elements are no single rings of round or oval wire; ComputationError where it is
/// interrupted, but for rolls, which come last.
Sheet answer(const RingFit& fit, const Question& question, unsigned threads, Progress& progress);

/// Grams per cubic centimetre.
struct Metal {
  const char* name;
  double density;
};
const std::vector<Metal>& metals();

/// A strain in percent with the mark of its confidence; without one the status.
std::string strain_text(const std::optional<double>& value, const std::string& status,
                        const std::string& confidence);
/// Marks behind the values of a sheet, one after the other.
std::string shown_marks(const Sheet& sheet);
/// What such marks say, a line each.
std::string explained_marks_of_sheets(const std::string& marks);

/// As a page for people, and as a document for programs.
std::string sheet_text(const Sheet& sheet);
boost::json::object sheet_json(const Sheet& sheet);

}  // namespace hauberk::maker
