#pragma once
/// What a weave is woven of, and for which rings it has room.

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/host/registry.hpp>

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::maker {

/// Diameters of a ring, mm.
struct Ring {
  double inner = 0.0, wire = 0.0;
};

/// What is asked; lengths in millimetres.
struct Question {
  std::string weave;            ///< name in the library, or path of a weave file
  double inner = 0.0;           ///< inner diameter of the rings, of two sizes of the large ones
  double wire = 0.0;            ///< diameter of their wire
  double gap = 0.4;             ///< that a printer needs between surfaces; 0: nobody prints it
  bool roll = false;            ///< whether to tell how tightly it is wound onto a rod
  std::optional<Ring> small{};  ///< the small rings of a weave of two sizes

  /// Whether both sizes are of one wire.
  bool one_wire() const { return !small || small->wire == wire; }
};

/// A weave file as far as it concerns makers.
struct Weave {
  std::string name, description;
  double smallest_ratio = 0.0;  ///< inner diameter over wire diameter; of two sizes that of the large rings
  bool two_sizes = false;
  struct Way {
    std::string name;  ///< "along the columns"
    double degrees = 0.0;
  };
  std::vector<Way> ways;  ///< at least one; of one alone it is a chain
};

/// Reads the weave. Throws InputError where there is none of that name, or where it is not woven of plain
/// rings: its parameters are not inner_diameter and wire_diameter, of two sizes also small_inner_diameter and
/// small_wire_diameter, none without the other.
Weave read_weave(const std::string& name, const WeaveLookup& lookup);

/// The experiment that the answers come from, as JSON text.
std::string experiment_text(const Weave& weave, const Question& question, double clearance);

/// What a weave's scenes are made with.
struct WeaveSource {
  Weave weave;
  WeaveLookup lookup;
  std::shared_ptr<const Registry> registry;
};

enum class Diameter { inner, wire, small_inner, small_wire };

/// Values of one diameter with which a weave has room: from `low` to `high`.
struct Range {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
};

/// For every diameter, all others being as asked for, the values around it with which a weave has room;
/// around the nearest such one where it has none; none where that is not within an eighth and eight times the
/// value. Wires of both sizes change alike where they are one.
struct Fitting {
  std::optional<Range> inner, wire;
  std::optional<Range> small_inner, small_wire;  ///< none of one size; the second none of one wire
  bool two_sizes = false;
};

/// As words: "rings from 3.578 mm on, or wire up to 2.683 mm"; ends are rounded inwards, so that each of them
/// has room. Empty where nothing alone would do.
std::string fitting_text(const Fitting& fitting);

/// For which rings a weave has room in the arrangement of its file. Of rings of one size their ratio decides;
/// of two, whether the scene has a rest state and as many links as with the sizes of the file. Thread safe.
class RingFit {
 public:
  /// Throws InputError where a weave of two sizes cannot be read, or has no rest state with its own sizes.
  explicit RingFit(WeaveSource source);

  const WeaveSource& source() const { return source_; }
  bool fits(const Question& question) const;

  /// Throws ComputationError where it is interrupted.
  Fitting fitting(const Question& question) const;

 private:
  std::optional<Range> range(const Question& question, Diameter diameter) const;

  WeaveSource source_;
  std::size_t links_ = 0;  ///< of two sizes, with those of the file
};

/// The rings as words: "rings of 8 mm, wire of 1.2 mm".
std::string rings_text(const Question& question);

}  // namespace hauberk::maker
