#include "document/json_text.hpp"
#include "document/jsonc.hpp"

#include <hauberk/error.hpp>
#include <hauberk/experiment/plugin_resolver.hpp>
#include <hauberk/experiment/stored_shapes.hpp>
#include <hauberk/experiment/union_shape.hpp>
#include <hauberk/host/factories.hpp>

#include <cmath>
#include <filesystem>
#include <utility>

namespace hauberk {
namespace {

/// The first file that the section names for its plugin and that is not there.
std::optional<std::string> missing_file(const Node& section, const PluginTable& table,
                                        const std::string& folder)
{
  for (const Field& field : plugin_fields(table)) {
    const Node* value = section.find(field.name);
    if (field.kind != Field::Kind::string || field.unit != "file" || value == nullptr) continue;
    std::error_code unknown;
    const std::filesystem::path file = std::filesystem::path(folder) / value->string;
    if (!std::filesystem::exists(file, unknown)) return file.string();
  }
  return std::nullopt;
}

std::vector<double> in_order(const Shape& shape, const std::map<std::string, double>& parameters)
{
  std::vector<double> out;
  for (const ParameterInfo& info : shape.parameters()) {
    const auto given = parameters.find(info.name);
    out.push_back(given != parameters.end() ? given->second : info.default_value);
    if (std::isnan(out.back())) throw InputError("parameters/" + info.name + ": missing");
  }
  return out;
}

}  // namespace

StoredShapes::StoredShapes(PluginLookup lookup, std::string folder)
    : lookup_(std::move(lookup)), folder_(std::move(folder))
{
}

std::optional<std::vector<Primitive>> StoredShapes::operator()(
    const std::string& /*type*/, const boost::json::value& section,
    const std::map<std::string, double>& parameters, std::string& why)
{
  const std::string text = write_json(section);
  if (const auto known = made_.find(text); known != made_.end())
    return known->second->primitives(in_order(*known->second, parameters));
  Problems problems;
  const std::optional<Node> node = read_jsonc(text, problems);
  const Node* id = node ? node->find("shape") : nullptr;
  if (id == nullptr || !id->is(Node::Type::string)) throw InputError("shape: missing");
  const PluginTable* table =
      id->string == union_table().id ? &union_table() : lookup_(PluginKind::shape, id->string, why);
  if (table == nullptr) return std::nullopt;
  if (const auto file = missing_file(*node, *table, folder_)) {
    why = "the surfaces of shape '" + id->string + "' need the file " + *file + ", which is not there";
    return std::nullopt;
  }
  PluginResolver resolver(lookup_, folder_, {});
  const std::shared_ptr<const Shape> shape = resolver.shape(*node, problems);
  if (!shape)
    throw InputError(problems.empty() ? "the shape '" + id->string + "' does not take these settings"
                                      : problems.list().front().message);
  made_.emplace(text, shape);
  return shape->primitives(in_order(*shape, parameters));
}

}  // namespace hauberk
