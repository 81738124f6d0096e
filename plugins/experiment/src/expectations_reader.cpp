#include "document/json_writer.hpp"
#include "document/node_access.hpp"
#include "sections.hpp"

namespace hauberk {

std::vector<Expectation> read_expectations(const Node& list, Problems& problems)
{
  std::vector<Expectation> expectations;
  for (const Node& item : list.items) {
    Expectation expected;
    const Node* pointer = item.find("pointer");
    const Node* value = item.find("value");
    if (value != nullptr) expected.value = to_boost_json(*value);
    expected.rel = optional_number(item, "rel");
    expected.abs = optional_number(item, "abs");
    expected.min = optional_number(item, "min");
    expected.max = optional_number(item, "max");
    if (value == nullptr && !expected.min && !expected.max && item.find("rel") == nullptr &&
        item.find("abs") == nullptr) {
      problems.add(item, "expected at least one of value, min, max");
    }
    for (const char* margin : {"rel", "abs"}) {
      const Node* node = item.find(margin);
      if (node == nullptr || (value != nullptr && value->is(Node::Type::number))) continue;
      problems.add(*node, std::string("'") + margin + "' needs a number in 'value'");
    }
    for (const char* bound : {"min", "max"}) {
      const Node* node = item.find(bound);
      if (node == nullptr || value == nullptr || value->is(Node::Type::number)) continue;
      problems.add(*node, std::string("'") + bound + "' needs a number in 'value', or no 'value'");
    }
    if (expected.min && expected.max && *expected.min > *expected.max) {
      problems.add(item, "expected min <= max, found min " + format_number(*expected.min) + " and max " +
                             format_number(*expected.max));
    }
    if (pointer == nullptr) continue;
    if (!pointer->string.starts_with('/')) {
      problems.add(*pointer,
                   "expected a JSON pointer such as /limits/0/value, found " + quote_json(pointer->string));
    }
    expected.pointer = pointer->string;
    expectations.push_back(std::move(expected));
  }
  return expectations;
}

}  // namespace hauberk
