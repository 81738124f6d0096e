#include "strut_frame.hpp"

#include <hauberk/plugin.hpp>

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin = {
    HAUBERK_HANDSHAKE,
    hauberk::PluginKind::shape,
    "strut_frame",
    "0.1.0",
    "Cages of straight round struts from a graph: polyhedra by name, OBJ line graphs, lists.",
    "Wang, Li, Hofmann, Andrade and Daraio, Nature 596 (2021); Zhou et al., Science 387 (2025) (polycatenated cages)",
    hauberk::strut_frame_fields,
    hauberk::make_strut_frame,
    nullptr,
    nullptr,
};
