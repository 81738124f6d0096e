#pragma once
/// What a command is called, takes and does, as data: its parser, --help, the manual page, the completions of
/// shells and the tables of share/doc/command.md are made from it.

#include <string>
#include <vector>

namespace hauberk::command {

/// What is offered to somebody who completes a word.
enum class Offer {
  nothing,
  words,        ///< the choices
  experiments,  ///< folders, and files that end in .json
  results,      ///< the same: a folder stands for the results.json in it
  folders,
  files,
  libraries,  ///< folders, and files that end in .so
  plugins     ///< ids of plugins that are found
};

/// A word that is no option.
struct Argument {
  std::string name;  ///< as usage and messages call it: EXPERIMENT.json
  Offer offer = Offer::nothing;
  std::vector<std::string> choices = {};
  std::string after = {};  ///< offered where the first argument is this word only; empty: always
  bool several = false;    ///< may be repeated
  bool optional = false;
};

/// What an option takes.
enum class Takes {
  nothing,
  text,
  texts,    ///< may be repeated
  integer,  ///< int
  natural,  ///< std::uint64_t
  real      ///< double
};

struct Option {
  std::string name;  ///< without dashes
  char letter = 0;   ///< of its short form, if it has one
  Takes takes = Takes::nothing;
  std::string value = {};  ///< what stands for the value: DIR
  std::string help = {};   ///< what it does: small letters, no full stop
  std::string more = {};   ///< further sentences, in the manual and the reference; `literal`
  Offer offer = Offer::nothing;
  std::vector<std::string> choices = {};
};

struct Description {
  std::string name;       ///< "run", "plugins new"
  std::string form = {};  ///< what follows its name in the overview of all commands
  std::string line = {};  ///< what it does: a few words
  std::string synopsis;   ///< how it is called, with its name
  std::string summary;    ///< sentences
  std::string more = {};  ///< further sentences, in the manual and the reference; `literal`
  std::vector<Argument> arguments = {};
  std::vector<Option> options = {};  ///< without --help, which every command has
};

/// --help, of every command.
Option help_option();

/// --json: the answer as a JSON document on standard output.
Option json_option();

/// --plugin-path: for every command that uses plugins.
Option plugin_path_option();

/// --set, --plugin-path: for every command that reads experiments.
std::vector<Option> experiment_options();

/// The argument of these commands.
Argument experiment_argument();

/// `own`, then `shared`.
std::vector<Option> joined(std::vector<Option> own, const std::vector<Option>& shared);

}  // namespace hauberk::command
