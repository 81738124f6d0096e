#include "options.hpp"

#include <boost/program_options/errors.hpp>
#include <boost/program_options/parsers.hpp>
#include <boost/program_options/positional_options.hpp>
#include <boost/program_options/value_semantic.hpp>
#include <fmt/format.h>

#include <sstream>

namespace hauberk::command {

namespace po = boost::program_options;

namespace {

constexpr unsigned help_width = 110;

}  // namespace

Options::Options(std::string synopsis, std::string summary, std::string positional)
    : synopsis_(std::move(synopsis)),
      summary_(std::move(summary)),
      name_(std::move(positional)),
      shown_("Options", help_width)
{
  shown_.add_options()("help,h", "show this and exit");
}

void Options::add_json_option() { shown_.add_options()("json", "as JSON, for programs"); }

void Options::add_experiment_options()
{
  shown_.add_options()("set", po::value<std::vector<std::string>>()->composing()->value_name("path=value"),
                       "replace a value of the file, e.g. /solver/tolerance=1e-3; may be repeated");
  shown_.add_options()("plugin-path", po::value<std::vector<std::string>>()->composing()->value_name("DIR"),
                       "folder that is searched for plugins first; may be repeated");
}

void Options::parse(const std::vector<std::string>& words)
{
  po::options_description all;
  all.add(shown_).add_options()("positional", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("positional", -1);
  try {
    // No guessing of abbreviated options: a script that relies on one breaks when an option is added.
    const int style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
    po::store(po::command_line_parser(words).options(all).positional(positional).style(style).run(), values_);
    po::notify(values_);
  } catch (const po::error& error) {
    throw UsageError(error.what(), usage());
  }
  if (has("help")) throw ShowHelp(usage());
  if (name_.empty()) return;
  const std::vector<std::string> given = list("positional");
  if (given.empty()) throw UsageError(fmt::format("{} is missing", name_), usage());
  if (given.size() > 1 && !several_)
    throw UsageError(fmt::format("one {} expected, found also '{}'", name_, given[1]), usage());
  given_ = given;
}

std::vector<std::string> Options::list(const char* name) const
{
  return has(name) ? get<std::vector<std::string>>(name) : std::vector<std::string>{};
}

std::string Options::usage() const
{
  std::ostringstream text;
  text << "Usage: hauberk " << synopsis_ << "\n" << summary_ << "\n\n" << shown_;
  return text.str();
}

}  // namespace hauberk::command
