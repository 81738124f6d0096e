#include "document/json_writer.hpp"

#include <boost/json/array.hpp>
#include <boost/json/object.hpp>

#include <cmath>
#include <cstdint>

namespace hauberk {

boost::json::value to_boost_json(const Node& node)
{
  switch (node.type) {
    case Node::Type::null:
      return nullptr;
    case Node::Type::boolean:
      return node.boolean;
    case Node::Type::string:
      return boost::json::value(node.string);
    case Node::Type::number: {
      const bool integer = node.number == std::floor(node.number) &&
                           std::abs(node.number) <= 9007199254740992.0 &&
                           !(node.number == 0.0 && std::signbit(node.number));
      if (integer) return static_cast<std::int64_t>(node.number);
      return node.number;
    }
    case Node::Type::array: {
      boost::json::array out;
      for (const Node& item : node.items) out.push_back(to_boost_json(item));
      return out;
    }
    case Node::Type::object: {
      boost::json::object out;
      for (const auto& [key, value] : node.members) out[key] = to_boost_json(value);
      return out;
    }
  }
  return nullptr;
}

}  // namespace hauberk
