#pragma once
/// A fabric as it is to be shown or printed: which surfaces, and where their copies lie.

#include "document/json_place.hpp"
#include "export/mesh.hpp"
#include "geometry/pose.hpp"
#include "model/scene.hpp"

#include <boost/json/value.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::exporting {

/// Elements of one state of a fabric, in the unit of the experiment.
struct Fabric {
  struct Element {
    std::string type;
    std::vector<double> parameters;
    std::vector<Primitive> primitives;  ///< in the element's frame
    Pose pose;
    Pose rest;
  };
  std::string name, unit;
  std::string state;  ///< "rest", "limit 3: stretch at 0 degrees"
  std::vector<Element> elements;
  std::vector<Vec3> lattice, rest_lattice;  ///< none of a patch
};

/// The scene of an experiment at rest.
Fabric fabric_of(const SceneSpec& scene, const std::string& name, const std::string& unit);

/// A state of results: "rest", "initial" (of a design), "final" (of a design: its last rest state),
/// "limit:K", or "SENSE:DEGREES", the first limit of that sense and direction. `scene` is that of the
/// experiment in them, which knows the shapes; parameters and poses are read. `file` is named in messages.
/// Throws InputError naming the state and what there is.
Fabric fabric_in_results(const boost::json::value& results, const std::string& file, const SceneSpec& scene,
                         const std::string& state);

/// A fabric at rest, moved to a limit of its results. Throws InputError where that has other poses.
Fabric at_limit(const Fabric& rest, const detail::JsonPlace& limit);

/// A contact of a limit, in the first cell.
struct ShownContact {
  std::array<int, 2> elements{};  ///< of the cell or patch; the second is -1 of a wall
  std::array<Vec3, 2> at;         ///< on the surface of each
  Vec3 force;                     ///< on the second; the first has its opposite. In 1/length: the load is one
  double gap = 0.0;               ///< less the clearance
};

/// The contacts of a limit in results. Throws InputError where they are damaged.
std::vector<ShownContact> contacts_of(const detail::JsonPlace& limit);

/// The same of "limit:K" or "SENSE:DEGREES". Throws InputError where results have no such limit.
std::vector<ShownContact> contacts_in_results(const boost::json::value& results, const std::string& file,
                                              const std::string& state);

/// A design's initial fabric with the values of an iterate, at the same places. `variables`: those of the
/// design in results; `values`: in their order. Throws InputError where these do not fit, or where shapes
/// refuse them.
Fabric with_design_values(const Fabric& initial, const detail::JsonPlace& variables,
                          const detail::JsonPlace& values, const SceneSpec& scene);

/// Which part of a periodic fabric is kept: elements whose middle is within at rest, about the middle of all.
struct Outline {
  double radius = 0.0;                 ///< of a disk; 0: a rectangle
  std::array<double, 2> half_sides{};  ///< of a rectangle
};

/// Copies of a fabric's cell along its vectors that fill an outline about their middle; of a patch and of a
/// solid 1 each.
std::array<int, 3> cells_that_fill(const Fabric& fabric, const Outline& outline);

/// Surfaces once, and their copies.
struct Assembly {
  struct Copy {
    int mesh = 0;
    int element = 0;             ///< of the cell or patch
    std::array<int, 3> image{};  ///< of the cell
    std::string name;            ///< "ring 3", "ring 3 [1, 0]"
    Pose pose, rest;
  };
  std::string name, unit, state;
  std::vector<Mesh> meshes;
  std::vector<std::string> mesh_names;             ///< the element's type, numbered where its sizes differ
  std::vector<std::vector<Primitive>> primitives;  ///< of each mesh
  std::vector<Copy> copies;
};

/// `repeat`: copies of the cell along its vectors; elements keep their order, cells the order of the last
/// vector slowest. `chord`: see element_mesh; 0: a fortieth of the thinnest wire's radius. Throws InputError
/// where an outline leaves nothing, where a patch is repeated, and beyond 100,000 copies.
Assembly assemble(const Fabric& fabric, std::array<int, 3> repeat, const std::optional<Outline>& outline,
                  double chord);

/// The nearest two copies: surface distance (certified to a millionth, or to rounding; 0 or below where they
/// overlap) and their names. None where there are not two, or where all pairs are farther apart than
/// `enough`.
struct Nearest {
  double distance = 0.0;
  std::array<std::string, 2> names;
  bool known = true;  ///< false: surfaces that conform were not looked at to the end; they are farther apart
};
std::optional<Nearest> nearest_copies(const Assembly& assembly, double enough);

}  // namespace hauberk::exporting
