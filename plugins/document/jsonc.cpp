#include "document/jsonc.hpp"

#include "document/json_cursor.hpp"
#include "document/number_text.hpp"
#include "document/utf8.hpp"

#include <cmath>
#include <limits>
#include <map>

namespace hauberk {

namespace {

class Reader {
 public:
  Reader(std::string_view text, Problems& problems) : cursor_(text), problems_(problems) {}

  Node read(const std::string& base)
  {
    cursor_.skip_space();
    Node root = value(base, 0);
    cursor_.skip_space();
    if (!cursor_.end()) cursor_.fail("end of file", base);
    return root;
  }

 private:
  JsonCursor cursor_;
  Problems& problems_;

  Node value(const std::string& pointer, int depth)
  {
    Node node;
    node.pointer = pointer;
    node.line = cursor_.line();
    if (depth > max_json_depth) {
      cursor_.stop("nested deeper than " + std::to_string(max_json_depth) + " levels", pointer);
    }
    const char c = cursor_.peek();
    if (!cursor_.end() && c == '{') {
      object(node, depth);
    } else if (!cursor_.end() && c == '[') {
      array(node, depth);
    } else if (c == '"') {
      node.type = Node::Type::string;
      node.string = cursor_.string(pointer);
    } else if (JsonCursor::is_word(c)) {
      scalar(node);
    } else {
      cursor_.fail("a value", pointer);
    }
    return node;
  }

  void object(Node& node, int depth)
  {
    node.type = Node::Type::object;
    cursor_.skip(1);
    std::map<std::string, int> first_line;
    for (;;) {
      cursor_.skip_space();
      if (cursor_.peek() == '}') break;
      if (cursor_.peek() != '"') cursor_.fail("a key in double quotes or '}'", node.pointer);
      const int key_line = cursor_.line();
      std::string key = cursor_.string(node.pointer);
      cursor_.skip_space();
      if (cursor_.peek() != ':') cursor_.fail("':' after key " + quoted(key), node.pointer);
      cursor_.skip(1);
      cursor_.skip_space();
      Node member = value(node.pointer + "/" + pointer_token(key), depth + 1);
      const auto [place, fresh] = first_line.emplace(key, key_line);
      if (fresh) {
        node.members.emplace_back(std::move(key), std::move(member));
      } else {
        problems_.add(
            {member.pointer, key_line,
             "duplicate key " + quoted(key) + ": first given on line " + std::to_string(place->second)});
      }
      cursor_.skip_space();
      if (cursor_.peek() == '}') break;
      if (cursor_.peek() != ',') cursor_.fail("',' or '}'", node.pointer);
      cursor_.skip(1);
    }
    cursor_.skip(1);
  }

  void array(Node& node, int depth)
  {
    node.type = Node::Type::array;
    cursor_.skip(1);
    for (;;) {
      cursor_.skip_space();
      if (cursor_.peek() == ']') break;
      node.items.push_back(value(node.pointer + "/" + std::to_string(node.items.size()), depth + 1));
      cursor_.skip_space();
      if (cursor_.peek() == ']') break;
      if (cursor_.peek() != ',') cursor_.fail("',' or ']'", node.pointer);
      cursor_.skip(1);
    }
    cursor_.skip(1);
  }

  static std::string quoted(const std::string& text) { return "'" + text + "'"; }

  /// A number or one of the words true, false, null.
  void scalar(Node& node)
  {
    const std::string_view token = cursor_.word();
    if (token == "true" || token == "false") {
      node.type = Node::Type::boolean;
      node.boolean = token == "true";
    } else if (token == "null") {
      node.type = Node::Type::null;
    } else if (is_not_finite_word(token)) {
      problems_.add({node.pointer, node.line, "expected a finite number, found " + std::string(token)});
      node.type = Node::Type::number;
      node.number = std::numeric_limits<double>::quiet_NaN();
    } else {
      number(node);
      return;
    }
    cursor_.skip(token.size());
  }

  void number(Node& node)
  {
    const std::string_view rest = cursor_.rest();
    const std::size_t size = json_number_size(rest);
    const bool goes_on = size < rest.size() && JsonCursor::is_word(rest[size]);
    if (size == 0 || goes_on) cursor_.fail("a value", node.pointer);
    const std::string_view token = rest.substr(0, size);
    node.type = Node::Type::number;
    node.number = parse_json_number(token);
    if (!std::isfinite(node.number)) {
      problems_.add({node.pointer, node.line,
                     "expected a finite number, found " + std::string(token.substr(0, 40)) +
                         ", which is beyond the largest double (about 1.8e308)"});
      node.number = std::numeric_limits<double>::quiet_NaN();
    }
    cursor_.skip(size);
  }
};

}  // namespace

std::optional<Node> read_jsonc(std::string_view text, Problems& problems, const std::string& base)
{
  if (const auto bad = find_invalid_utf8(text)) {
    problems.add({base, bad->line,
                  "syntax error at column " + std::to_string(bad->column) +
                      ": expected UTF-8 text, found the byte " + bad->byte});
    return std::nullopt;
  }
  try {
    return Reader(text, problems).read(base);
  } catch (const JsonSyntaxError& error) {
    problems.add({error.pointer, error.line, error.message});
    return std::nullopt;
  }
}

std::string pointer_token(std::string_view key)
{
  std::string token;
  for (const char c : key) {
    if (c == '~')
      token += "~0";
    else if (c == '/')
      token += "~1";
    else
      token += c;
  }
  return token;
}

std::string pointer_key(std::string_view token)
{
  std::string key;
  for (std::size_t k = 0; k < token.size(); ++k) {
    if (token[k] == '~' && k + 1 < token.size() && (token[k + 1] == '0' || token[k + 1] == '1')) {
      key += token[++k] == '0' ? '~' : '/';
    } else {
      key += token[k];
    }
  }
  return key;
}

bool pointer_within(std::string_view pointer, std::string_view root)
{
  return pointer.starts_with(root) && (pointer.size() == root.size() || pointer[root.size()] == '/');
}

void relocate(Node& node, const std::string& base, int line)
{
  node.pointer = base;
  node.line = line;
  for (std::size_t k = 0; k < node.items.size(); ++k)
    relocate(node.items[k], base + "/" + std::to_string(k), line);
  for (auto& [key, value] : node.members) relocate(value, base + "/" + pointer_token(key), line);
}

}  // namespace hauberk
