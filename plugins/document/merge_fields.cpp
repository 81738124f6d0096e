#include "document/merge_fields.hpp"

#include <algorithm>
#include <utility>

namespace hauberk {

std::vector<Field> merge_fields(std::vector<Field> declared, const std::vector<Field>& extra)
{
  for (const Field& field : extra) {
    const auto same =
        std::find_if(declared.begin(), declared.end(), [&](const Field& f) { return f.name == field.name; });
    if (same != declared.end())
      *same = field;
    else
      declared.push_back(field);
  }
  return declared;
}

}  // namespace hauberk
