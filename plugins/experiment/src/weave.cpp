#include "weave.hpp"

#include "document/check.hpp"
#include "document/field_helpers.hpp"
#include "document/jsonc.hpp"
#include "document/node_access.hpp"

#include <hauberk/experiment/fields.hpp>
#include <hauberk/suggestion.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace hauberk {

namespace {

using namespace fields;

using Lengths = std::map<std::string, double>;

/// What a weave file holds. Lengths in elements and cell may be sums: {"R": 2, "r": -1}.
Field weave_file_fields()
{
  const Field sum = map("sum", "Factors of lengths.", number("factor", "Factor.", "1"));
  Field parameter = object(
      "parameter", "A length that an experiment may give.",
      {required(number("default", "Value where it gives none.", "length")), string("doc", "What it is.")});
  Field buildable =
      object("buildable", "For which ratio of two lengths the places leave room.",
             {required(at_least_items(list("ratio", "Names of two lengths.", string("name", "A name.")), 2)),
              number("at_least", "Smallest ratio.", "1"), number("at_most", "Largest ratio.", "1")});
  Field cell = object("cell", "The cell.",
                      {required(any("vectors", "As in experiments.")), required(any("place", "Likewise."))});
  return object(
      "weave", "A weave file.",
      {required(string("name", "Name.")), string("description", "What it is."),
       required(map("parameters", "Lengths by name.", std::move(parameter))),
       with_default(map("lengths", "Further lengths, sums of those before.", sum), "{}"),
       map("ways", "Names of directions, in degrees from x.", number("direction", "Direction.", "degree")),
       list("links", "Links of every place with others.", integer("count", "Number of links.")),
       std::move(buildable), required(any("elements", "As in experiments.")), required(std::move(cell))});
}

bool is_sum(const Node& node, const Lengths& lengths)
{
  return node.is(Node::Type::object) && !node.members.empty() &&
         std::all_of(node.members.begin(), node.members.end(), [&](const auto& term) {
           return term.second.is(Node::Type::number) && lengths.contains(term.first);
         });
}

double sum_of(const Node& node, const Lengths& lengths)
{
  double x = 0.0;
  for (const auto& [name, factor] : node.members) x += factor.number * lengths.at(name);
  return x;
}

void replace_sums(Node& node, const Lengths& lengths)
{
  if (is_sum(node, lengths)) {
    node = number_node(sum_of(node, lengths));
    return;
  }
  for (Node& item : node.items) replace_sums(item, lengths);
  for (auto& [name, value] : node.members) replace_sums(value, lengths);
}

/// The checked file, or nothing.
std::optional<Node> read_weave_file(const Node& name, const WeaveLookup& weaves, Problems& problems)
{
  std::string error = "there is no library of weaves";
  const std::optional<std::string> text = weaves ? weaves(name.string, error) : std::nullopt;
  if (!text) {
    problems.add(name, error);
    return std::nullopt;
  }
  Problems wrong;
  std::optional<Node> file = read_jsonc(*text, wrong);
  if (file) check_fields(*file, weave_file_fields(), wrong);
  for (const Problem& p : wrong.list()) {
    problems.add(name, "weave '" + name.string + "', line " + std::to_string(p.line) + ": " +
                           (p.pointer.empty() ? "" : p.pointer + ": ") + p.message);
  }
  return wrong.empty() ? std::move(file) : std::nullopt;
}

/// Parameters as given or by default, and what follows from them.
std::optional<Lengths> read_lengths(const Node& section, const Node& file, Problems& problems)
{
  Lengths out;
  std::vector<std::string> known;
  for (const auto& [name, parameter] : file.at("parameters").members) {
    out[name] = number_or(parameter, "default", 0.0);
    known.push_back(name);
  }
  bool good = true;
  if (const Node* given = find_typed(section, "parameters", Node::Type::object)) {
    for (const auto& [name, value] : given->members) {
      if (!out.contains(name)) {
        problems.add(value, "the weave has no parameter '" + name + "'" + suggestion(name, known));
        good = false;
      } else {
        out[name] = value.number;
      }
    }
  }
  for (const auto& [name, sum] : file.at("lengths").members) {
    if (!is_sum(sum, out)) {
      problems.add(section,
                   "the weave's length '" + name + "' is no sum of its parameters and earlier lengths");
      return std::nullopt;
    }
    out[name] = sum_of(sum, out);
  }
  return good ? std::optional(std::move(out)) : std::nullopt;
}

/// `value` of the file at `key` of `section`, its lines those of the experiment's reference to the weave.
void put(Node& section, const std::string& key, Node value, int line)
{
  relocate(value, section.pointer + "/" + pointer_token(key), line);
  section.members.emplace_back(key, std::move(value));
}

bool put_elements(Node& root, const Node& weave, Node elements, Problems& problems)
{
  if (root.find("elements") == nullptr) {
    put(root, "elements", std::move(elements), weave.line);
    return true;
  }
  Node& own = *find_mutable(root, "elements");
  if (!own.is(Node::Type::object)) return true;  // reported when it is checked
  for (auto& [name, element] : elements.members) {
    if (const Node* same = own.find(name)) {
      problems.add(*same, "the weave has an element '" + name + "' already; rename this one");
      return false;
    }
    put(own, name, std::move(element), weave.line);
  }
  return true;
}

Field& child(Field& parent, const std::string& name)
{
  return *std::find_if(parent.children.begin(), parent.children.end(),
                       [&name](const Field& f) { return f.name == name; });
}

}  // namespace

Field weave_field()
{
  return object(
      "weave", "A weave of the library (share/doc/weaves.md) instead of elements, vectors and place.",
      {required(string("name",
                       "Name in the library, or path of a weave file, seen from the experiment's "
                       "folder: anything with '/' or '.' in it.")),
       with_default(map("parameters", "The weave's lengths by name; the others keep their defaults.",
                        number("parameter", "Value of one parameter.", "length")),
                    "{}")});
}

Field expanded_fields(TaskFormats formats)
{
  Field root = experiment_fields(formats);
  child(root, "elements").required = true;
  Field& cell = child(root, "cell");
  child(cell, "place").required = true;
  child(child(cell, "patch"), "vectors").required = true;
  std::erase_if(cell.children, [](const Field& f) { return f.name == "weave"; });
  return root;
}

bool expand_weave(Node& root, const WeaveLookup& weaves, Problems& problems)
{
  Node* cell = find_mutable(root, "cell");
  const Node* found = cell != nullptr ? cell->find("weave") : nullptr;
  if (found == nullptr) return true;
  Node weave = *found;
  const std::size_t before = problems.list().size();
  check_fields(weave, weave_field(), problems);
  for (const char* key : {"vectors", "place"}) {
    if (const Node* other = cell->find(key))
      problems.add(*other, std::string("a weave has its own places; remove '") + key + "', or the weave");
  }
  Node* patch = find_mutable(*cell, "patch");
  if (patch != nullptr && !patch->is(Node::Type::object)) return true;  // reported when it is checked
  if (const Node* other = patch != nullptr ? patch->find("vectors") : nullptr)
    problems.add(*other,
                 "a patch of a weave is laid out with the weave's vectors; remove these, or the weave");
  if (problems.list().size() != before) return false;
  const std::optional<Node> file = read_weave_file(weave.at("name"), weaves, problems);
  if (!file) return false;
  const std::optional<Lengths> lengths = read_lengths(weave, *file, problems);
  if (!lengths) return false;
  Node elements = file->at("elements"), vectors = file->at("cell").at("vectors"),
       place = file->at("cell").at("place");
  for (Node* part : {&elements, &vectors, &place}) replace_sums(*part, *lengths);
  std::erase_if(cell->members, [](const auto& member) { return member.first == "weave"; });
  // `cell` has changed: the patch is where it is now.
  Node* laid_out = find_mutable(*cell, "patch");
  put(laid_out != nullptr ? *laid_out : *cell, "vectors", std::move(vectors), weave.line);
  put(*cell, "place", std::move(place), weave.line);
  return put_elements(root, weave, std::move(elements), problems);
}

void keep_weave(Node& expanded, const Node& written)
{
  const Node* cell = written.find("cell");
  const Node* weave = cell != nullptr ? cell->find("weave") : nullptr;
  if (weave == nullptr) return;
  Node& own = *find_mutable(expanded, "cell");
  std::erase_if(own.members,
                [](const auto& member) { return member.first == "vectors" || member.first == "place"; });
  if (Node* patch = find_mutable(own, "patch"))
    std::erase_if(patch->members, [](const auto& member) { return member.first == "vectors"; });
  own.members.emplace_back("weave", *weave);
  // Of the elements only those that the experiment has itself.
  const Node* elements = written.find("elements");
  std::erase_if(find_mutable(expanded, "elements")->members, [&](const auto& element) {
    return elements == nullptr || elements->find(element.first) == nullptr;
  });
  if (elements == nullptr)
    std::erase_if(expanded.members, [](const auto& member) { return member.first == "elements"; });
}

}  // namespace hauberk
