#include "options.hpp"

#include <fmt/format.h>
#include <boost/program_options/errors.hpp>
#include <boost/program_options/parsers.hpp>
#include <boost/program_options/positional_options.hpp>
#include <boost/program_options/value_semantic.hpp>

#include <algorithm>
#include <cstdint>
#include <sstream>

namespace hauberk::command {

namespace po = boost::program_options;

namespace {

constexpr unsigned help_width = 110;

/// The parser of an option's value. Boost takes it over.
const po::value_semantic* semantic(const Option& option)
{
  const char* name = option.value.c_str();
  switch (option.takes) {
    case Takes::nothing:
      return new po::untyped_value(true);
    case Takes::text:
      return po::value<std::string>()->value_name(name);
    case Takes::texts:
      return po::value<std::vector<std::string>>()->composing()->value_name(name);
    case Takes::integer:
      return po::value<int>()->value_name(name);
    case Takes::natural:
      return po::value<std::uint64_t>()->value_name(name);
    case Takes::real:
      return po::value<double>()->value_name(name);
  }
  return nullptr;
}

void add(po::options_description& shown, const Option& option)
{
  const std::string name =
      option.letter != 0 ? fmt::format("{},{}", option.name, option.letter) : option.name;
  shown.add_options()(name.c_str(), semantic(option), option.help.c_str());
}

/// "NAME and DIR"
std::string names(const std::vector<Argument>& arguments, const char* between)
{
  std::string text;
  for (const Argument& argument : arguments) text += (text.empty() ? "" : between) + argument.name;
  return text;
}

/// Throws UsageError for arguments that are missing, or too many.
void check_count(const std::vector<Argument>& arguments, const std::vector<std::string>& given,
                 const std::string& usage)
{
  if (arguments.empty()) {
    if (!given.empty()) throw UsageError(fmt::format("expected options only, found '{}'", given[0]), usage);
    return;
  }
  if (std::all_of(arguments.begin(), arguments.end(), [](const Argument& a) { return a.optional; })) return;
  if (given.empty()) throw UsageError(fmt::format("{} is missing", names(arguments, " ")), usage);
  if (arguments.size() > 1 && given.size() != arguments.size())
    throw UsageError(fmt::format("expected {}", names(arguments, " and ")), usage);
  if (given.size() > arguments.size() && !arguments.back().several)
    throw UsageError(fmt::format("one {} expected, found also '{}'", arguments.back().name, given[1]), usage);
}

}  // namespace

Options::Options(Description description)
    : description_(std::move(description)), shown_("Options", help_width)
{
  add(shown_, help_option());
  for (const Option& option : description_.options) add(shown_, option);
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
  given_ = list("positional");
  check_count(description_.arguments, given_, usage());
}

std::vector<std::string> Options::list(const char* name) const
{
  return has(name) ? get<std::vector<std::string>>(name) : std::vector<std::string>{};
}

std::string Options::usage() const
{
  std::ostringstream text;
  text << "Usage: hauberk " << description_.synopsis << "\n" << description_.summary << "\n\n" << shown_;
  return text.str();
}

}  // namespace hauberk::command
