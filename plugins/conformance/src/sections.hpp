#pragma once
/// Sections of an experiment for a plugin: made from its fields, read from a text, altered in one place.

#include <hauberk/conformance/check.hpp>

#include <string>
#include <vector>

namespace hauberk::conformance {

/// A section that was checked against the plugin's fields, defaults filled in.
struct Section {
  Field fields;     ///< an object whose children are the plugin's fields
  Node values;      ///< what the factory is given
  Node parameters;  ///< of a shape, when the setup gives any; else null
};

/// Throws Failure when the fields make no section that they accept themselves.
Section read_section(const PluginTable& table, const Setup& setup);

/// A section with one value of its top level replaced by another one that the fields allow.
struct Variant {
  std::string field, value;  ///< its name, and the new value for people
  Node values;
};

/// Extremes of numbers, the other choices, flipped switches.
std::vector<Variant> variants(const Section& section);

/// Sections in which one switch is set otherwise: every boolean, every choice and every other kind of value
/// that a field takes, at any depth. Those that the fields themselves refuse are left out.
std::vector<Variant> switched(const Section& section);

/// Multiplies every number of unit "length" in `node`, which has the form of `field`, by `factor`.
void scale_lengths(Node& node, const Field& field, double factor);

}  // namespace hauberk::conformance
