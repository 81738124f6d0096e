#include "values.hpp"

#include "document/field_helpers.hpp"
#include "document/node_access.hpp"

#include <hauberk/linalg.hpp>
#include <hauberk/suggestion.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace hauberk {
namespace {

/// Longer or deeper ones are no formula that somebody wrote.
constexpr std::size_t longest = 1000;
constexpr int deepest = 50;
constexpr std::size_t most_open = 50;

/// What is wrong with an expression.
struct Mistake : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Function {
  const char* name;
  double (*value)(double);
};
constexpr std::array functions{
    Function{"sqrt", [](double x) { return std::sqrt(x); }},
    Function{"sin", [](double x) { return std::sin(x * degree); }},
    Function{"cos", [](double x) { return std::cos(x * degree); }},
    Function{"tan", [](double x) { return std::tan(x * degree); }},
    Function{"asin", [](double x) { return std::asin(x) / degree; }},
    Function{"acos", [](double x) { return std::acos(x) / degree; }},
    Function{"atan", [](double x) { return std::atan(x) / degree; }},
};

class Expression {
 public:
  using ValueOf = std::function<double(const std::string&)>;

  Expression(std::string_view text, const ValueOf& value_of) : text_(text), value_of_(value_of) {}

  double value()
  {
    if (text_.size() > longest) throw Mistake(fmt::format("longer than {} characters", longest));
    const double x = sum();
    blanks();
    if (at_ != text_.size()) throw Mistake(fmt::format("'{}' was not expected", text_.substr(at_)));
    if (!std::isfinite(x)) throw Mistake("it comes to no finite number");
    return x;
  }

 private:
  double sum()
  {
    if (++depth_ > deepest) throw Mistake(fmt::format("nested more than {} deep", deepest));
    double x = product();
    for (;;) {
      if (take('+'))
        x += product();
      else if (take('-'))
        x -= product();
      else
        break;
    }
    --depth_;
    return x;
  }

  double product()
  {
    double x = factor();
    for (;;) {
      if (take('*'))
        x *= factor();
      else if (take('/'))
        x /= factor();
      else
        return x;
    }
  }

  double factor()
  {
    if (++depth_ > deepest) throw Mistake(fmt::format("nested more than {} deep", deepest));
    const double x = take('-') ? -factor() : power();
    --depth_;
    return x;
  }

  double power()
  {
    const double base = atom();
    return take('^') ? std::pow(base, factor()) : base;
  }

  double atom()
  {
    if (take('(')) return closed();
    if (take('$')) return value_of_(std::string(name()));
    blanks();
    if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0) {
      const std::string_view word = name();
      if (word == "pi") return std::numbers::pi;
      const auto* const function = std::find_if(functions.begin(), functions.end(),
                                                [word](const Function& f) { return f.name == word; });
      if (function == functions.end())
        throw Mistake(fmt::format("'{0}' is no function; a named value is written ${0}", word));
      if (!take('(')) throw Mistake(fmt::format("expected '(' after {}", word));
      return function->value(closed());
    }
    double x = 0.0;
    const char* const end = text_.data() + text_.size();
    const auto read = std::from_chars(text_.data() + at_, end, x);
    if (read.ec != std::errc{})
      throw Mistake(at_ == text_.size() ? "it ends where a number is expected"
                                        : fmt::format("expected a number at '{}'", text_.substr(at_)));
    at_ = static_cast<std::size_t>(read.ptr - text_.data());
    return x;
  }

  double closed()
  {
    const double x = sum();
    if (!take(')')) throw Mistake("')' is missing");
    return x;
  }

  std::string_view name()
  {
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    if (at_ == begin) throw Mistake("'$' without a name");
    return text_.substr(begin, at_ - begin);
  }

  void blanks()
  {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  bool take(char c)
  {
    blanks();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  std::string_view text_;
  const ValueOf& value_of_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

bool is_expression(const Node& node)
{
  return node.is(Node::Type::string) && (node.string.starts_with('$') || node.string.starts_with('='));
}

/// The values by name, each worked out when it is first asked for.
class Values {
 public:
  explicit Values(const Node* section)
  {
    if (section == nullptr || !section->is(Node::Type::object)) return;
    for (const auto& [name, node] : section->members) {
      given_.emplace(name, &node);
      names_.push_back(name);
    }
  }

  double of(const Node& node)
  {
    const Expression::ValueOf value_of = [this](const std::string& name) { return named(name); };
    return Expression(std::string_view(node.string).substr(node.string.starts_with('=') ? 1 : 0), value_of)
        .value();
  }

 private:
  double named(const std::string& name)
  {
    const auto found = given_.find(name);
    if (found == given_.end())
      throw Mistake(fmt::format("there is no value '{}'{}", name, suggestion(name, names_)));
    const Node& node = *found->second;
    if (node.is(Node::Type::number)) return node.number;
    if (const auto known = known_.find(name); known != known_.end()) return known->second;
    if (!is_expression(node)) throw Mistake(fmt::format("the value '{}' is no number", name));
    if (std::find(open_.begin(), open_.end(), name) != open_.end())
      throw Mistake(fmt::format("the value '{}' depends on itself", name));
    if (open_.size() >= most_open)
      throw Mistake(fmt::format("it depends on more than {} values in a row", most_open));
    open_.push_back(name);
    const double x = of(node);
    open_.pop_back();
    return known_[name] = x;
  }

  std::map<std::string, const Node*> given_;
  std::map<std::string, double> known_;
  std::vector<std::string> names_, open_;
};

void replace(Node& node, Values& values, Problems& problems)
{
  if (is_expression(node)) {
    Node number = node;
    number.type = Node::Type::number;
    number.string.clear();
    try {
      number.number = values.of(node);
    } catch (const Mistake& mistake) {
      problems.add(node, fmt::format("'{}': {}", node.string, mistake.what()));
      number.number = 1.0;  // so that it is told of once
    }
    node = std::move(number);
    return;
  }
  for (Node& item : node.items) replace(item, values, problems);
  for (auto& [name, member] : node.members) {
    if (name != "name") replace(member, values, problems);  // what it is called is no number
  }
}

}  // namespace

Field values_field()
{
  using namespace fields;
  return map(
      "values",
      "Numbers by name. Wherever a number is expected, a string such as \"$pitch/2\" or \"=sqrt(2)*$pitch\" stands for one: + - * / ^, "
      "parentheses, $names, pi, sqrt, and sin, cos, tan, asin, acos, atan of degrees. Values may be such "
      "strings, too.",
      number("value", "A number, in any unit.", "1"));
}

void put_values(Node& root, Problems& problems)
{
  if (!root.is(Node::Type::object)) return;
  const Node* found = root.find("values");
  const Node section = found != nullptr ? *found : Node{};
  Values values(found != nullptr ? &section : nullptr);
  for (auto& [name, member] : root.members) {
    if (name != "name" && name != "description" && name != "$schema" && name != "expect")
      replace(member, values, problems);
  }
}

void keep_values(Node& expanded, const Node& written)
{
  if (is_expression(written) && expanded.is(Node::Type::number)) {
    expanded = written;
    return;
  }
  for (std::size_t k = 0; k < std::min(expanded.items.size(), written.items.size()); ++k)
    keep_values(expanded.items[k], written.items[k]);
  for (auto& [name, member] : expanded.members) {
    if (const Node* same = written.find(name)) keep_values(member, *same);
  }
}

}  // namespace hauberk
