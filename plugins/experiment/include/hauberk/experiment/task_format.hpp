#pragma once
/// What the format of experiments knows of a task: its name, and its section with fields and a reader. The
/// tasks themselves give it.

#include <hauberk/experiment/experiment.hpp>
#include <hauberk/experiment/plugin_resolver.hpp>
#include <hauberk/section.hpp>

#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace hauberk {

/// What a section's reader may look at: scene, load case and solver have been read.
struct SectionContext {
  const Experiment& experiment;
  const std::vector<int>& tile_of;  ///< see ReadScene
  bool scene_complete = false;      ///< nothing was wrong with it
  const VariantBase& base;          ///< what variants of the file start from
  PluginResolver& plugins;
  Problems& problems;
};

/// Reports entries of `directions` (degrees, and where they stand) that repeat an earlier one modulo 180, and
/// those at which the load of the experiment's load case, if it is there, is zero.
void check_directions(const std::vector<std::pair<const Node*, double>>& directions,
                      const Experiment& experiment, Problems& problems);

struct TaskFormat {
  std::string_view name;  ///< of the task, and of its section
  Field (*field)();       ///< the section
  /// Reads the checked section, reports mistakes and writes defaults that depend on other sections back.
  std::shared_ptr<const TaskSection> (*read)(Node& section, SectionContext& context);
  /// Reports what only the whole file shows, once everything is read; `section` is what `read` returned.
  /// Null: nothing.
  void (*check)(const TaskSection& section, const Node& resolved, Problems& problems) = nullptr;
  /// Keys of the section that say how an answer is searched, not which: what a file expects stands whatever
  /// they are.
  std::span<const std::string_view> search_keys = {};
  bool makes_variants = false;     ///< experiments are made out of the file
  bool brings_directions = false;  ///< the load case need not name any, and names angles only
};

}  // namespace hauberk
