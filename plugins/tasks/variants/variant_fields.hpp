#pragma once
/// Fields of the sections that make variants of a file.

#include <hauberk/section.hpp>

#include <string>

namespace hauberk {

/// `set`: values by JSON pointer.
Field set_field(const std::string& doc);

/// `vary`: lists of values at places, all equally long; `each` is what a variant is called. Neither required
/// nor defaulted.
Field vary_field(const std::string& each);

/// `labels` of the variants.
Field labels_field(const std::string& each);

}  // namespace hauberk
