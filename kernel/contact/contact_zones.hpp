#pragma once
/// Forces that are spread over surfaces, gathered into one for each zone of contact.

#include "contact/side_terms.hpp"

namespace hauberk {

/// The force at a place of an integral, as a node of a zone; `gap` is the distance of the surfaces less the
/// clearance.
ContactPoint zone_node(const ProbePoint& q, const FieldValue& f, double gap, double clearance, double force);

/// Adds one resultant for each contact zone: nodes are taken by falling force and join the first zone near
/// whose seed they lie: within a few widths sqrt(2 r g_hat), and no further than g_hat from the plane in
/// which it touches. Where surfaces conform, a zone bends around a tube and is cut into as many as that
/// takes: a single resultant would act at a point far from both surfaces.
void add_contact_zones(const PairFrame& frame, double g_hat, double clearance,
                       std::vector<ContactPoint> nodes, std::vector<ContactPoint>& out);

}  // namespace hauberk
