/// Every plugin of the tree conforms, in the settings that differ most: those of which each is a test of its
/// own have no switches set otherwise. (Optimizers: optimizers/common/test.)

#include <hauberk/conformance/gtest.hpp>

namespace {

const std::string folder = HAUBERK_BINARY_DIR "/lib/hauberk/plugins/";

HAUBERK_CONFORMANCE_TESTS(TorusUnion, folder + "torus_union.so");
HAUBERK_CONFORMANCE_TESTS(TorusUnionThreefold, folder + "torus_union.so", R"({
  "shape": "torus_union",
  "tori": [
    { "name": "centre" },
    { "name": "south", "group": "side", "axis": "tangential",
      "position": { "direction_deg": -90, "distance": ["centre.R", "side.R", 0.25] } },
    { "name": "east", "group": "side", "axis": [1, 2, 3], "position": [4.5, 0.5, 1] }
  ],
  "parameters": { "centre.R": 4.25, "centre.r0": 0.95, "centre.r1": 0.95,
                  "side.R": 2.575, "side.r0": 0.95, "side.r1": 1.5 } })");
HAUBERK_CONFORMANCE_TESTS(Mesh, folder + "mesh.so",
                          R"({ "shape": "mesh", "file": ")" HAUBERK_SOURCE_DIR
                          R"(/shapes/mesh/frame.obj" })");
HAUBERK_CONFORMANCE_TESTS(ClosedTubeOval, folder + "closed_tube.so",
                          R"({ "shape": "closed_tube", "curve": "oval" })", 1, false);
HAUBERK_CONFORMANCE_TESTS(ClosedTubeRacetrack, folder + "closed_tube.so",
                          R"({ "shape": "closed_tube", "curve": "racetrack" })", 1, false);
HAUBERK_CONFORMANCE_TESTS(ClosedTubePolygon, folder + "closed_tube.so",
                          R"({ "shape": "closed_tube", "curve": "polygon" })", 1, false);
HAUBERK_CONFORMANCE_TESTS(ClosedTubeKnot, folder + "closed_tube.so",
                          R"({ "shape": "closed_tube", "curve": "knot" })", 1, false);
HAUBERK_CONFORMANCE_TESTS(ClosedTubeFourier, folder + "closed_tube.so",
                          R"({ "shape": "closed_tube", "curve": "fourier" })", 1, false);
HAUBERK_CONFORMANCE_TESTS(StrutFrameOctahedron, folder + "strut_frame.so",
                          R"({ "shape": "strut_frame", "polyhedron": "octahedron",
                               "parameters": { "size": 10, "r": 0.5 } })",
                          1, false);
HAUBERK_CONFORMANCE_TESTS(StrutFrameListed, folder + "strut_frame.so",
                          R"({ "shape": "strut_frame", "nodes": [[0, 0, 0], [2, 0, 0], [1, 3, 1]],
                               "struts": [[0, 1], [1, 2], [2, 0]], "parameters": { "size": 1, "r": 0.1 } })",
                          1, false);
HAUBERK_CONFORMANCE_TESTS(RoundedRing, folder + "rounded_ring.so",
                          R"({ "shape": "rounded_ring",
                               "parameters": { "R": 5, "w": 0.7, "h": 0.5, "corner": 0.2 } })");
HAUBERK_CONFORMANCE_TESTS(SplineTube, folder + "spline_tube.so",
                          R"({ "shape": "spline_tube",
                               "nodes": [[6, 0, 0, 0.8], [0, 5, 0.3, 0.6], [-6, 0, 0, 0.8], [0, -5, -0.3, 0.6]] })",
                          1, false);
HAUBERK_CONFORMANCE_TESTS(InPlanePeriodic, folder + "in_plane_periodic.so");
HAUBERK_CONFORMANCE_TESTS(InPlanePeriodicEquation12, folder + "in_plane_periodic.so",
                          R"({ "measure": "equation_12", "hold": [] })");
HAUBERK_CONFORMANCE_TESTS(InPlanePeriodicLayer, folder + "in_plane_periodic.so",
                          R"({ "out_of_plane": 0.3 })");
HAUBERK_CONFORMANCE_TESTS(InPlanePeriodicFree, folder + "in_plane_periodic.so",
                          R"({ "out_of_plane": "free" })");
HAUBERK_CONFORMANCE_TESTS(VolumetricPeriodic, folder + "volumetric_periodic.so");
HAUBERK_CONFORMANCE_TESTS(ParaboloidBending, folder + "paraboloid_bending.so");
HAUBERK_CONFORMANCE_TESTS(ParaboloidBendingPlaces, folder + "paraboloid_bending.so",
                          R"({ "hold": ["places", "twist"] })");
HAUBERK_CONFORMANCE_TESTS(CylinderRoll, folder + "cylinder_roll.so");
HAUBERK_CONFORMANCE_TESTS(StripRoll, folder + "strip_roll.so");
HAUBERK_CONFORMANCE_TESTS(StripRollFree, folder + "strip_roll.so", R"({ "out_of_plane": "free" })");
HAUBERK_CONFORMANCE_TESTS(CylinderRollFree, folder + "cylinder_roll.so",
                          R"({ "hold": [], "out_of_plane": "free" })");
HAUBERK_CONFORMANCE_TESTS(CylinderRollPlaces, folder + "cylinder_roll.so",
                          R"({ "hold": ["places", "twist", "transverse"], "out_of_plane": "free" })");

}  // namespace
