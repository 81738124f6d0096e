#include "obj_text.hpp"

#include "text_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <charconv>
#include <system_error>

namespace hauberk::detail {

void ObjText::refuse(const std::string& what, int line) const
{
  throw InputError(fmt::format("{}:{}: {}", name_, line, what));
}

bool ObjText::next()
{
  if (text_.empty()) return false;
  first_ = ++number_;
  rest_ = next_line(text_);
  if (continued(rest_)) {
    joined_.clear();
    while (continued(rest_)) {
      joined_.append(rest_.substr(0, rest_.rfind('\\'))).append(" ");
      rest_ = next_line(text_);
      ++number_;
    }
    joined_.append(rest_);
    rest_ = joined_;
  }
  rest_ = rest_.substr(0, rest_.find('#'));
  key_ = next_word();
  return true;
}

bool ObjText::continued(std::string_view line) const
{
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line.ends_with('\\') && !text_.empty();
}

std::string_view ObjText::next_word() { return detail::next_word(rest_); }

Vec3 ObjText::point()
{
  Vec3 x;
  for (double& coordinate : x) {
    const std::string_view word = next_word();
    if (word.empty()) refuse("expected three numbers after 'v'");
    if (!read_number(word, coordinate)) refuse("expected a finite number, found " + quoted(word));
  }
  return x;
}

int ObjText::index(std::string_view word, std::size_t count) const
{
  const std::string_view digits = word.substr(0, word.find('/'));
  int index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (error != std::errc() || end != digits.data() + digits.size() || index == 0)
    refuse("expected the number of a point, counted from 1 or from -1 backwards, found " + quoted(word));
  const std::string_view rest = word.substr(digits.size());
  if (rest.find_first_not_of("/-0123456789") != std::string_view::npos)
    refuse("expected a corner such as 3, 3/1, 3//1 or 3/1/1, found " + quoted(word));
  const long known = static_cast<long>(count);
  if (index < 0 && known + index < 0) refuse(fmt::format("found point {} after {} points", index, known));
  return static_cast<int>(index < 0 ? known + index : index - 1L);
}

}  // namespace hauberk::detail
