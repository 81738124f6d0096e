#include "run/provenance.hpp"

#include "document/json_text.hpp"
#include "document/json_values.hpp"
#include "document/json_writer.hpp"
#include "run/machine.hpp"

#include <hauberk/error.hpp>
#include <hauberk/version.hpp>

#include <fmt/format.h>
#include <boost/json/serialize.hpp>
#include <boost/version.hpp>

#include <cholmod.h>
#include <algorithm>

namespace hauberk {
namespace {

namespace json = boost::json;

using Named = std::vector<std::pair<std::string, std::string>>;

/// Texts by name below a key of the provenance, which is left out where there are none.
bool same_texts(const json::object& provenance, const char* key, const Named& now)
{
  const json::value* then = provenance.if_contains(key);
  if (then == nullptr) return now.empty();
  const json::object& texts = then->as_object();
  return texts.size() == now.size() && std::all_of(now.begin(), now.end(), [&](const auto& named) {
           const json::value* text = texts.if_contains(named.first);
           return text != nullptr && text->as_string() == std::string_view(named.second);
         });
}

/// Throws where a plugin was another library then. Documents that tell no digest are taken.
void check_plugins(const json::value& then, const std::vector<Provenance::Plugin>& now)
{
  for (const json::value& plugin : then.at("plugins").as_array()) {
    const json::value* digest = plugin.as_object().if_contains("sha256");
    for (const Provenance::Plugin& own : now) {
      if (digest == nullptr || plugin.at("id").as_string() != own.id) continue;
      if (digest->as_string() != own.sha256)
        throw InputError(fmt::format(
            "it was computed with another library of the plugin '{}', see /provenance/plugins; bring that back, "
            "or start anew with --force",
            own.id));
    }
  }
}

}  // namespace

Provenance provenance(const Prepared& prepared, unsigned threads, bool machine)
{
  Provenance p;
  p.version = version;
  p.build_type = build_type;
  p.compiler = HAUBERK_COMPILER " (" __VERSION__ "), " HAUBERK_STDLIB;
  p.libraries = {
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Boost",
       fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"CHOLMOD",
       fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)}};
  p.plugins = prepared.plugins;
  p.weaves = prepared.weaves;
  p.files = prepared.files;
  p.seed = prepared.experiment.seed;
  p.threads = static_cast<int>(threads);
  if (machine) p.machine = this_machine();
  return p;
}

std::string identity(const Prepared& prepared, const Provenance& provenance)
{
  json::object origin = provenance_json(provenance);
  for (const char* varies : {"threads", "peak_memory_bytes", "processors"}) origin.erase(varies);
  return json::serialize(
      json::object{{"experiment", parse_json(write_json(prepared.experiment.resolved), "experiment")},
                   {"provenance", origin}});
}

void check_origin(const json::value& document, const Prepared& prepared)
{
  if (const json::string_view format = document.at("format").as_string(); format != results_format)
    throw InputError(
        fmt::format("it has the format {}, and this program goes on from {} alone; start anew with --force",
                    format, results_format));
  const Provenance now = provenance(prepared, 1, false);
  const json::value experiment = parse_json(write_json(prepared.experiment.resolved), "experiment");
  if (document.at("experiment") != experiment)
    throw InputError(
        "it was computed from another experiment; give the same file and --set, or start anew with --force");
  const json::value& then = document.at("provenance");
  check_plugins(then, now.plugins);
  // Rows and members are made of weaves that the experiment only names, elements of files.
  if (!same_texts(then.as_object(), "files", now.files))
    throw InputError(
        "it was computed from another file of the same name, see /provenance/files; bring that back, or "
        "start anew with --force");
  if (!same_texts(then.as_object(), "weaves", now.weaves))
    throw InputError(
        "it was computed from another weave of this name; bring its file back (the results hold it, below "
        "/provenance/weaves), or start anew with --force");
  if (text_of(then.at("version")) != now.version || text_of(then.at("build").at("type")) != now.build_type)
    throw InputError(fmt::format(
        "it was computed by version {} ({}), this is {} ({}); start anew with --force",
        text_of(then.at("version")), text_of(then.at("build").at("type")), now.version, now.build_type));
}

}  // namespace hauberk
