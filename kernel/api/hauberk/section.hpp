#pragma once
/// Settings as plugins see them: a checked value tree, the place of every value in its file, and the
/// declarative table of fields from which reading, checking, defaults, documentation and the schema
/// file are all derived. Knows no JSON library.

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hauberk {

/// One value of an experiment file. Objects keep the order of the file.
struct Node {
  enum class Type { null, boolean, number, string, array, object };

  // Defined out of line: a vector of pairs that hold an incomplete Node cannot be copied in the class.
  Node();
  ~Node();
  Node(const Node&);
  Node(Node&&) noexcept;
  Node& operator=(const Node&);
  Node& operator=(Node&&) noexcept;

  Type type = Type::null;
  std::string pointer;  ///< RFC 6901 pointer from the root, "" for the root
  int line = 0;         ///< 1-based line in the file; 0: a default, or given on the command line
  bool boolean = false;
  double number = 0.0;
  std::string string;
  std::vector<Node> items;                            ///< array
  std::vector<std::pair<std::string, Node>> members;  ///< object

  /// Member `key` of an object, null when absent or when this is no object.
  const Node* find(std::string_view key) const;
  /// Member `key`; throws std::out_of_range that names the pointer when absent (a defect of the caller:
  /// required and defaulted fields are always there after checking).
  const Node& at(std::string_view key) const;
  bool is(Type t) const { return type == t; }
  /// Numbers of an array of numbers.
  std::vector<double> numbers() const;
};

/// One thing that is wrong, and where.
struct Problem {
  std::string pointer;
  int line = 0;
  std::string message;  ///< what was expected, what was found, the way out
};

/// Collects every problem of a file so that all are reported at once.
class Problems {
 public:
  void add(const Node& where, std::string message);
  void add(Problem problem) { list_.push_back(std::move(problem)); }
  bool empty() const { return list_.empty(); }
  const std::vector<Problem>& list() const { return list_; }

 private:
  std::vector<Problem> list_;
};

/// Declares one field of a settings section.
struct Field {
  enum class Kind {
    number,   ///< finite number within [minimum, maximum]
    integer,  ///< number without fractional part, same range
    boolean,
    string,
    choice,   ///< string out of `choices`
    numbers,  ///< array of numbers, min_items .. max_items, each within [minimum, maximum]
    list,     ///< array; children[0] describes an item
    object,   ///< members are `children`; others are errors
    map,      ///< object with free keys; children[0] describes a value
    any_of,   ///< any one of `children`, told apart by their JSON type
    any       ///< anything; checked by who declared it
  };

  std::string name;
  Kind kind = Kind::number;
  std::string doc;  ///< one sentence
  /// "length", "degree", "1", "" (none); of a string "file": a path, relative to the experiment's file where
  /// it is not absolute. Factories are given the path from the working directory.
  std::string unit;
  bool required = false;
  std::string default_json;  ///< default as JSON text; empty: none (absent stays absent)
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusive_minimum = false;
  std::vector<std::string> choices;
  std::size_t min_items = 0;
  std::size_t max_items = std::numeric_limits<std::size_t>::max();
  std::vector<Field> children;
};

}  // namespace hauberk
