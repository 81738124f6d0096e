#pragma once
/// Files of an assembly. All are made whole in memory, with the same bytes for the same assembly, and are
/// thread safe.

#include "export/fabric.hpp"

#include <string>

namespace hauberk::exporting {

/// Colours of meshes, red, green, blue from 0 to 255; the eighth is followed by the first.
std::array<int, 3> colour_of(int mesh);

/// Binary STL: all copies as one list of triangles, in the unit of the experiment, which STL does not name.
std::string stl(const Assembly& assembly);

/// Wavefront OBJ: a group for each copy, named by it; points of copies are written out.
std::string obj(const Assembly& assembly);

/// How 3MF holds an assembly. Slicers lay every item on the bed by itself, at times elsewhere: what is linked
/// stays so in one object alone.
enum class Objects {
  one,      ///< all copies are one mesh, coloured by triangles, whose lowest coordinates the item moves to 0
  separate  ///< an object for each mesh, an item with its name and place for each copy
};

/// 3MF; the unit is kept. Throws InputError where the program was built without libzip.
std::string three_mf(const Assembly& assembly, Objects objects);

/// Binary glTF 2.0: a mesh for each, a node for each copy, named, in metres and with y upwards, as glTF has
/// it. Where copies are not at rest, an animation of two seconds takes them there from rest, by places and
/// turns that change evenly: a picture of the motion, not the motion itself, which has contact.
std::string glb(const Assembly& assembly);

/// VTK XML of an unstructured grid: triangles of all copies with the number of their copy and mesh. Of each
/// contact two vertices of kind -1, on either surface, with the number of its element (-1: of a wall) and, as
/// data of points, the force on that element and the gap; points of triangles have zeros there.
std::string vtu(const Assembly& assembly, const std::vector<ShownContact>& contacts);

}  // namespace hauberk::exporting
