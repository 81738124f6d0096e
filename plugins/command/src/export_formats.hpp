#pragma once
/// The formats of `hauberk export`, by the ending of a file's name; what users read of them follows.

#include "export/page.hpp"
#include "opened_fabric.hpp"

#include <string>
#include <string_view>

namespace hauberk::command {

/// What a file is made of.
struct Exported {
  const Opened& opened;
  const exporting::Assembly& assembly;
  const exporting::PageView& view;  ///< how a page shows the same
  const Options& options;
};

struct ExportFormat {
  std::string_view ending;  ///< with its point, lower case
  std::string (*content)(const Exported&);
  bool shows_all_states = false;  ///< so that none is chosen
};

/// The format of a file. Throws UsageError with the endings that there are.
const ExportFormat& export_format_of(const std::string& file, const Options& options);

/// Endings without points: "stl, obj or png", and "stl,obj,png".
std::string export_endings();
std::string export_endings_between_commas();

/// Throws UsageError where an option is given that another format alone has a use for.
void refuse_options_of_others(const ExportFormat& format, const Options& options);

}  // namespace hauberk::command
