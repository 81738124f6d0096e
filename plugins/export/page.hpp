#pragma once
/// One page that shows a fabric in three dimensions, at rest and moved to each of its limits.

#include "export/fabric.hpp"

#include <boost/json/value.hpp>

#include <string>

namespace hauberk::exporting {

/// Template of the page and script of its viewer, as share/web has them.
struct PageParts {
  std::string html, viewer;
};

/// Reads both from a folder. Throws InputError, with the way out, where the viewer was not built.
PageParts read_page_parts(const std::string& folder);

/// The page of an assembly at rest. `results`, if not null, are those that it comes from: every limit with
/// poses is a state of the page, with its contact forces, and all limits are in its table; `scene` is that of
/// their experiment. `file` is named in messages. One file that needs no network; thread safe.
std::string page(const Assembly& rest, const boost::json::value& results, const std::string& file,
                 const SceneSpec& scene, const PageParts& parts);

}  // namespace hauberk::exporting
