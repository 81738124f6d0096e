#pragma once
/// Shapes of a stored experiment: made anew from what its results have kept of it.

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/shape.hpp>

#include <boost/json/value.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hauberk {

/// Makes primitives from sections of a stored experiment, for the independent check (VerifyShapes). Shapes
/// are made once. Files that a shape reads are looked for by their paths as the experiment has them, from
/// `folder`. Not thread safe.
class StoredShapes {
 public:
  /// `folder`: that relative paths of files are from; empty: the current one.
  explicit StoredShapes(PluginLookup lookup, std::string folder = "");

  /// Primitives at these parameters, those that are not given at their defaults. Nothing where the plugin or
  /// a file of it is not there, with the reason in `why`. Throws InputError for a section or parameters that
  /// the shape refuses, PluginError where the plugin fails.
  std::optional<std::vector<Primitive>> operator()(const std::string& type, const boost::json::value& section,
                                                   const std::map<std::string, double>& parameters,
                                                   std::string& why);

 private:
  PluginLookup lookup_;
  std::string folder_;
  std::map<std::string, std::shared_ptr<const Shape>> made_;  ///< by the text of their sections
};

}  // namespace hauberk
