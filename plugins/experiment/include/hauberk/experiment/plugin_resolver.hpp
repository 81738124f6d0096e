#pragma once
/// What a reader of experiments asks of plugins, so that it knows none of them.

#include "document/check.hpp"

#include <hauberk/experiment/experiment.hpp>

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace hauberk {

/// Optimizer of an experiment that is run by a program with one of its own (ExperimentSource::optimizer).
inline constexpr const char* callers_optimizer = "caller";

/// Looks plugins up once each, and makes what sections ask for. Whatever a plugin does wrong becomes a
/// problem.
class PluginResolver {
 public:
  /// `folder`: that plugins' files are relative to. `optimizer`: what `callers_optimizer` is; may be null.
  PluginResolver(const PluginLookup& lookup, std::string folder, FileObserver files,
                 std::shared_ptr<const Optimizer> optimizer = {})
      : lookup_(lookup),
        folder_(std::move(folder)),
        files_(std::move(files)),
        callers_optimizer_(std::move(optimizer))
  {
  }

  /// The plugin named by `section`, null when it names none or there is none.
  const PluginTable* find(const Node& section, PluginKind kind, const char* key);

  /// For check_fields: the fields of the plugin of a section; reports plugins that are missing.
  ExtraFields extra_fields(const Field& field, const Node& object, Problems& problems);

  /// Of an element: that of its plugin, or the union of its parts.
  std::shared_ptr<const Shape> shape(const Node& section, Problems& problems);
  std::shared_ptr<const LoadCase> load_case(const Node& section, double length, Problems& problems);
  std::shared_ptr<const Optimizer> optimizer(const Node& section, Problems& problems);

 private:
  struct Found {
    const PluginTable* table = nullptr;
    std::string error;
  };
  /// The shape of a plugin.
  std::shared_ptr<const Shape> part(const Node& section, Problems& problems);
  const Found& look_up(PluginKind kind, const std::string& id);

  const PluginLookup& lookup_;
  /// Calls a factory with the section, in which paths of files are as seen from here; what it throws is
  /// reported at the section.
  template <class Factory>
  auto make_guarded(const Node& section, const PluginTable* table, Problems& problems, const Factory& factory)
      -> decltype(factory(section));
  Node located(const Node& section, const PluginTable& table) const;

  std::string folder_;
  FileObserver files_;
  std::shared_ptr<const Optimizer> callers_optimizer_;
  std::map<std::pair<PluginKind, std::string>, Found> found_;
};

/// Names of a shape's parameters.
std::vector<std::string> parameter_names(const Shape& shape);

/// Index of a parameter, -1 when the shape has none of that name.
int parameter_index(const Shape& shape, std::string_view name);

}  // namespace hauberk
