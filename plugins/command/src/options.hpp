#pragma once
/// Words of a command line, parsed as the description of their command says.

#include "description.hpp"

#include <hauberk/error.hpp>

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/variables_map.hpp>

#include <string>
#include <vector>

namespace hauberk::command {

/// A wrong command line. `what` says what is wrong, `usage` how it should look.
class UsageError : public InputError {
 public:
  UsageError(const std::string& what, std::string usage) : InputError(what), usage_(std::move(usage)) {}
  const std::string& usage() const { return usage_; }

 private:
  std::string usage_;
};

/// --help was asked for; not an error.
class ShowHelp {
 public:
  explicit ShowHelp(std::string text) : text_(std::move(text)) {}
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Parser of one command's words: positional arguments, usually one, and options.
class Options {
 public:
  explicit Options(Description description);

  /// Counts the arguments, unless all of them are optional: then the command looks at them itself. Throws
  /// UsageError, or ShowHelp.
  void parse(const std::vector<std::string>& words);

  const std::string& positional() const { return given_.front(); }
  const std::vector<std::string>& positionals() const { return given_; }
  bool has(const char* name) const { return values_.count(name) > 0; }
  template <class T>
  const T& get(const char* name) const
  {
    return values_[name].as<T>();
  }
  /// Values of an option that may be repeated; empty when it is absent.
  std::vector<std::string> list(const char* name) const;
  std::string usage() const;

 private:
  Description description_;
  std::vector<std::string> given_;
  boost::program_options::options_description shown_;
  boost::program_options::variables_map values_;
};

}  // namespace hauberk::command
