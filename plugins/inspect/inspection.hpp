#pragma once
/// What a model of other programs is: its bodies, how far they are apart, what is linked with what, and what
/// a printer will make of it.

#include "inspect/model_file.hpp"

#include <boost/json/object.hpp>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::inspecting {

/// Lengths are in the file's unit.
struct InspectedBody {
  std::string name;     ///< "body 3", or the file's
  std::string problem;  ///< why it is no closed surface; empty: it is one
  std::size_t triangles = 0;
  std::array<Vec3, 2> box;  ///< lowest and highest coordinates
  double volume = 0.0;      ///< enclosed; 0 of what is not closed
  std::size_t handles = 0;  ///< of the surface: 1 of a ring, 0 of a ball
  bool inside_out = false;  ///< its triangles face inwards
  bool hollow = false;      ///< and it is within another body: the wall of a cavity
  double thinnest_wall =
      0.0;  ///< least way through the body from the middles of triangles that were looked at; 0: none
  std::vector<int> linked;  ///< bodies that it is linked with
  int piece = 0;            ///< bodies of one number hang together by links
};

struct NearBodies {
  std::array<int, 2> bodies{};
  double distance = 0.0;  ///< of their triangles, exact up to rounding; 0 where they meet
};

struct LinkedBodies {
  std::array<int, 2> bodies{};
  int number =
      0;  ///< greatest common divisor of the linking numbers of all their loops: 1 of rings in a chain
};

struct Inspection {
  std::string file, unit;
  std::vector<InspectedBody> bodies;
  std::optional<NearBodies> nearest;       ///< none where there are not two closed bodies
  std::vector<NearBodies> too_near;        ///< nearer than asked for, the nearest first
  std::vector<std::array<int, 2>> within;  ///< one of the two is wholly within the other's surface
  std::vector<LinkedBodies> links;
  int pieces = 0;             ///< that hang together by links, of closed bodies
  std::size_t objects = 1;    ///< see ModelFile
  bool linked_apart = false;  ///< bodies of different objects are linked
  std::array<Vec3, 2> box{};  ///< lowest and highest coordinates of all bodies
  int on_bed = 0;  ///< closed bodies that reach down to its lowest z, to a thousandth of the model's height
  double overhang =
      0.0;  ///< part of the area that faces down, steeper than 45 degrees, and does not lie on the bed

  /// Something is wrong: a body is damaged, two meet, or are nearer than asked for.
  bool failed() const;
};

/// Looks at all bodies and pairs. `gap`: see `too_near`. Bodies whose boxes are apart are not linked, and are
/// near each other only as far as boxes are. Thread safe. Throws what `keep_going` throws.
Inspection inspect(
    const ModelFile& model, const std::string& file, double gap,
    const std::function<void()>& keep_going = [] {});

/// Tables for people.
std::string inspection_text(const Inspection& inspection, double gap);

/// The same for programs; share/doc/export.md explains it.
boost::json::object inspection_json(const Inspection& inspection, double gap);

}  // namespace hauberk::inspecting
