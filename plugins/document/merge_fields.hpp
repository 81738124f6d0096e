#pragma once
/// Fields that one declaration takes over from another.

#include <hauberk/section.hpp>

#include <vector>

namespace hauberk {

/// `declared` with `extra` appended; an extra field replaces a declared one of the same name.
std::vector<Field> merge_fields(std::vector<Field> declared, const std::vector<Field>& extra);

}  // namespace hauberk
