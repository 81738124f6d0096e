#pragma once
/// A maker's answers about a weave of given rings: whether it can be woven, how far it gives, what it weighs.

#include "limits/limit_result.hpp"
#include "run/progress.hpp"

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/host/registry.hpp>

#include <boost/json/object.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::maker {

/// What is asked; lengths in millimetres.
struct Question {
  std::string weave;   ///< name in the library, or path of a weave file
  double inner = 0.0;  ///< inner diameter of the rings
  double wire = 0.0;   ///< diameter of their wire
  double gap = 0.4;    ///< that a printer needs between surfaces
  bool roll = false;   ///< whether to tell how tightly it is wound onto a rod
};

/// A weave file as far as it concerns makers.
struct Weave {
  std::string name, description;
  double smallest_ratio =
      0.0;  ///< inner diameter over wire diameter; below, no arrangement of the file has room
  struct Way {
    std::string name;  ///< "along the columns"
    double degrees = 0.0;
  };
  std::vector<Way> ways;  ///< at least one; of one alone it is a chain
};

/// Reads the weave. Throws InputError where there is none of that name, or where it is not woven of plain
/// rings (its parameters are not `inner_diameter` and `wire_diameter`).
Weave read_weave(const std::string& name, const WeaveLookup& lookup);

/// One way of the sheet. Pitches, in mm, are how far the pattern repeats itself along the way.
struct WayAnswer {
  std::string name;
  double degrees = 0.0;
  double pitch = 0.0;                       ///< at rest
  std::optional<double> stretch, compress;  ///< of the length at rest; none where there is no locked state
  std::string stretch_status, compress_status;
};

/// A strip of the sheet, wound onto a rod: bent along the way.
struct RollAnswer {
  std::string name;
  double degrees = 0.0;
  int rows = 0;                    ///< cells beside each other, along the way
  double turns = 0.0;              ///< that they go around
  std::optional<double> up, down;  ///< smallest radius of the sheet's middle, mm; none without a locked state
  std::string up_status, down_status;
};

/// All answers.
struct Sheet {
  Question question;
  Weave weave;
  double ratio = 0.0;           ///< inner / wire
  double smallest_inner = 0.0;  ///< of this wire, mm
  double thickest_wire = 0.0;   ///< of this inner diameter, mm
  bool chain = false;
  double rings = 0.0;        ///< per dm^2 at rest, per metre of a chain
  double ring_volume = 0.0;  ///< mm^3: 2 pi^2 R r^2
  std::vector<WayAnswer> ways;
  std::vector<RollAnswer> rolls;    ///< none of a chain
  bool printable = false;           ///< whether the weave has room for the gap
  std::vector<WayAnswer> with_gap;  ///< what the gap leaves; none where it has no room
};

/// Whether the rings are wide enough for their wire.
bool can_be_woven(const Weave& weave, const Question& question);

/// The experiment that the answers come from, as JSON text.
std::string experiment_text(const Weave& weave, const Question& question, double clearance);

/// Computes the answers, with `can_be_woven`. Limits are those of the load's direction with the shear held,
/// in the plane (of a chain free to leave it). Throws what preparing and computing an experiment throws;
/// ComputationError where it is interrupted.
Sheet answer(const Weave& weave, const Question& question, const WeaveLookup& lookup,
             const std::shared_ptr<const Registry>& registry, unsigned threads, Progress& progress);

/// Grams per cubic centimetre.
struct Metal {
  const char* name;
  double density;
};
const std::vector<Metal>& metals();

/// As a page for people, and as a document for programs.
std::string sheet_text(const Sheet& sheet);
boost::json::object sheet_json(const Sheet& sheet);

}  // namespace hauberk::maker
