#pragma once
/// Shapes whose parts are shapes.

#include <hauberk/section.hpp>
#include <hauberk/shape.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hauberk {

/// Makes the shape of a part's section; null where something is wrong with it, which has been reported.
using PartMaker = std::function<std::shared_ptr<const Shape>(const Node& part)>;

/// Makes a union from its checked section. What is wrong goes to `problems`, and then null is returned.
std::shared_ptr<const Shape> make_union(const Node& section, const PartMaker& make_part, Problems& problems);

/// What keeps a plugin from describing a part, by the fields that it declares; empty when nothing does.
std::string unfit_for_parts(const std::vector<Field>& fields);

}  // namespace hauberk
