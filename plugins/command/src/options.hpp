#pragma once
/// Options of a sub-command: declared, parsed and explained in one place.

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

/// Parser of one sub-command's words: positional arguments, usually one, and options.
class Options {
 public:
  /// `positional` is its name in messages ("EXPERIMENT.json"), `synopsis` follows "Usage: hauberk ".
  Options(std::string synopsis, std::string summary, std::string positional);

  /// Options are added to this.
  boost::program_options::options_description& add() { return shown_; }

  /// --json: the answer as a JSON document on standard output.
  void add_json_option();

  /// --plugin-path, --set: for every command that reads experiments.
  void add_experiment_options();

  /// The positional argument may be given several times.
  void take_several() { several_ = true; }

  /// Throws UsageError, or ShowHelp.
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
  std::string synopsis_, summary_, name_;
  bool several_ = false;
  std::vector<std::string> given_;
  boost::program_options::options_description shown_;
  boost::program_options::variables_map values_;
};

}  // namespace hauberk::command
