#include "mesh.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "mesh",
    "0.1.0",
    "Closed surface of triangles from a Wavefront OBJ or STL file, for contact mesh.",
    "Li et al., Incremental Potential Contact, ACM Transactions on Graphics 39 (2020): contact of triangle "
    "meshes",
    hauberk::mesh_fields,
    hauberk::make_mesh,
    nullptr,
    nullptr,
};
