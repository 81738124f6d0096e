#pragma once
/// Values of documents that this program wrote: null stands for what is not there. What does not fit throws
/// what Boost.JSON throws. Thread safe.

#include <boost/json/value.hpp>

#include <optional>
#include <string>

namespace hauberk {

inline double number_or_zero(const boost::json::value& v)
{
  return v.is_null() ? 0.0 : v.to_number<double>();
}

inline std::optional<double> number_or_none(const boost::json::value& v)
{
  return v.is_null() ? std::nullopt : std::optional(v.to_number<double>());
}

inline std::string text_of(const boost::json::value& v) { return std::string(v.as_string()); }

}  // namespace hauberk
