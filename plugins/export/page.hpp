#pragma once
/// One page that shows fabrics in three dimensions, at rest and moved to each of their limits; designs as
/// they were, as they became and how they came there.

#include "export/fabric.hpp"

#include <boost/json/object.hpp>
#include <boost/json/value.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::exporting {

/// Template of the page and script of its viewer, as share/web has them.
struct PageParts {
  std::string html, viewer;
};

/// Reads both from a folder. Throws InputError, with the way out, where the viewer was not built.
PageParts read_page_parts(const std::string& folder);

/// A picture that stands below the table.
struct Figure {
  std::string name;  ///< what it is called: that of its file
  std::string svg;
};

/// Cells that a page shows where nobody asks for other: about two dozen elements of a sheet, so that one sees
/// how they hold each other, one cell of a solid.
std::array<int, 3> shown_cells(const Fabric& fabric);

/// How a page shows the fabrics of an experiment or of results.
struct PageView {
  /// Copies of the cell; without: shown_cells().
  std::optional<std::array<int, 3>> repeat = {};
  std::optional<Outline> outline = {};
  double chord = 0.0;  ///< see element_mesh; 0: a sixteenth of the thinnest wire's radius
  std::vector<Figure> figures = {};
};

/// What a page shows of an experiment alone: its rest.
boost::json::object page_entry(const Fabric& rest, const PageView& view);

/// What a page shows of results: every limit with poses is a state, with its contact forces, and all limits
/// are in the table; of a design its initial fabric, the shapes of its iterates, and the fabric that came of
/// it. `scene` is that of their experiment; `file` is named in messages. Throws InputError where results are
/// damaged, and what `assemble` throws. Thread safe.
boost::json::object page_entry(const boost::json::value& results, const std::string& file,
                               const SceneSpec& scene, const PageView& view);

/// One file that needs no network, of one or more entries. Thread safe.
std::string page(std::vector<boost::json::object> entries, const PageParts& parts);

}  // namespace hauberk::exporting
