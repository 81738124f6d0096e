#include "document/check.hpp"

#include <hauberk/experiment/fields.hpp>
#include <hauberk/experiment/schema.hpp>
#include <hauberk/experiment/union_shape.hpp>
#include <hauberk/host/factories.hpp>

namespace hauberk {

namespace {

using Kind = Field::Kind;

const char* introduction =
    "# Experiment files\n"
    "\n"
    "An experiment is JSON with comments and trailing commas. This page is generated from the table of "
    "fields "
    "that also checks the files and makes `share/schema/experiment.schema.json`; a test fails when it is out "
    "of date. `hauberk check FILE` reports everything that is wrong in a file at once.\n"
    "\n"
    "In the headings, `*` stands for any name and any index. Lengths are in the unit of the file. A key in "
    "**bold** is required.\n";

std::string escape_cell(const std::string& text)
{
  std::string out;
  for (const char c : text) {
    if (c == '|')
      out += "\\|";
    else
      out += c;
  }
  return out;
}

/// A described object and where it stands.
struct Section {
  std::string place;
  std::string doc;
  const std::vector<Field>* fields;
};

/// Objects below `field`, which stands at `place`.
void collect(const Field& field, const std::string& place, std::vector<Section>& out)
{
  switch (field.kind) {
    case Kind::object:
      out.push_back({place, field.doc, &field.children});
      return;
    case Kind::list:
    case Kind::map:
      if (!field.children.empty()) collect(field.children[0], place + "/*", out);
      return;
    case Kind::any_of:
      for (const Field& child : field.children) collect(child, place, out);
      return;
    default:
      return;
  }
}

/// What a field means; of a list of names also what each of them does.
std::string meaning(const Field& field)
{
  const bool names = field.kind == Kind::list && !field.children.empty() &&
                     field.children[0].kind == Kind::choice && !field.children[0].doc.empty();
  return names ? field.doc + " " + field.children[0].doc : field.doc;
}

void write_section(const Section& section, std::string& out)
{
  out += "\n## `" + (section.place.empty() ? std::string("/") : section.place) + "`\n\n";
  if (!section.doc.empty()) out += section.doc + "\n\n";
  out += "| key | value | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const Field& field : *section.fields) {
    const std::string key = "`" + field.name + "`";
    out += "| " + (field.required ? "**" + key + "**" : key) + " | " + escape_cell(describe_expected(field)) +
           " | " + escape_cell(field.unit) + " | " +
           (field.default_json.empty() ? "" : "`" + escape_cell(field.default_json) + "`") + " | " +
           escape_cell(meaning(field)) + " |\n";
  }
  std::vector<Section> below;
  for (const Field& field : *section.fields) collect(field, section.place + "/" + field.name, below);
  for (const Section& next : below) write_section(next, out);
}

const char* section_place(PluginKind kind)
{
  switch (kind) {
    case PluginKind::shape:
      return "/elements/*";
    case PluginKind::load_case:
      return "/load_case";
    case PluginKind::optimizer:
      return "/design/optimizer";
  }
  return "";
}

void write_table(const std::string& what, const PluginTable& table, std::string& out)
{
  const std::vector<Field> fields = plugin_fields(table);
  out += "\n# " + what + " `" + table.id + "`\n\n" + table.summary + "\n\n";
  out +=
      fields.empty() ? "It has no fields of its own.\n" : fields_reference(fields, section_place(table.kind));
}

const char* union_text =
    "\n"
    "Of two parts, a ring (`torus_union`) called `eye` with its centre at x = 6 and a strut (`strut_frame`) "
    "called `shank`:\n"
    "\n"
    "    \"link\": { \"shape\": \"union\",\n"
    "      \"parts\": [\n"
    "        { \"name\": \"eye\", \"shape\": \"torus_union\", \"tori\": [{ \"name\": \"ring\" }], "
    "\"position\": [6, 0, 0] },\n"
    "        { \"name\": \"shank\", \"shape\": \"strut_frame\", \"nodes\": [[-1, 0, 0], [1, 0, 0]], "
    "\"struts\": [[0, 1]] } ],\n"
    "      \"parameters\": { \"eye.ring.R\": 3, \"eye.ring.r0\": 0.5, \"eye.ring.r1\": 0.5, "
    "\"shank.size\": 3, \"shank.r\": 0.5 } }\n"
    "\n"
    "Its parameters are those of its parts, as above, and their places `eye.x`, `eye.y`, `eye.z` (6, 0, 0) and\n"
    "`shank.x`, `shank.y`, `shank.z` (0, 0, 0), and turns of parts: `eye.rx`, `eye.ry` and `eye.rz` (0, 0, 0) are the rotation\n"
    "vector, in degrees, by which `eye` is turned about its origin, in the element frame, after its `rotation`: (0, 0, 30) turns\n"
    "it by 30 degrees about the element's z axis. Each is from -180 to 180. Designs and sweeps may vary places and turns like any\n"
    "other parameter. Primitives are called `eye.ring` and `shank.strut_0`. Of parts that nothing joins, which\n"
    "move as one all the same, `check`, `run` and `export` warn. Parts that overlap may close loops together, by which\n"
    "elements are linked. `share/experiments/hook_and_eye.json` is a chain of unions, `frame_links.json` one of frames whose sides are struts of their own, and in `bent_links.json` a turn is designed.\n";

}  // namespace

std::string fields_reference(const std::vector<Field>& fields, const std::string& place)
{
  std::string out;
  write_section({place, "", &fields}, out);
  return out.substr(1);  // without the empty line before the first heading
}

std::string experiment_reference(std::span<const PluginTable* const> plugins, TaskFormats formats)
{
  const Field root = experiment_fields(formats);
  std::string out = introduction;
  write_section({"", "", &root.children}, out);
  for (const PluginTable* plugin : plugins) write_table("Plugin", *plugin, out);
  write_table("Shape", union_table(), out);
  out += union_text;
  return out;
}

}  // namespace hauberk
