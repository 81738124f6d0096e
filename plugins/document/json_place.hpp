#pragma once
/// A value in a results document that knows where it stands, for messages.

#include <boost/json/value.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hauberk::detail {

/// A view: document and file name must outlive it. Everything throws InputError with file, JSON pointer and
/// what was expected there. Thread safe.
class JsonPlace {
 public:
  JsonPlace(const boost::json::value& document, const std::string& file) : value_(&document), file_(&file) {}

  /// Member of an object; there must be one.
  JsonPlace at(const char* key) const;
  /// The same; none where it is missing or null.
  std::optional<JsonPlace> find(const char* key) const;
  /// Entries of an array.
  std::vector<JsonPlace> items() const;

  double number() const;
  std::int64_t integer() const;
  std::string text() const;
  bool boolean() const;
  /// Number of a member; none where it is missing or null.
  std::optional<double> optional_number(const char* key) const;

  const boost::json::value& value() const { return *value_; }
  /// "FILE: POINTER: `what`".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  JsonPlace below(const boost::json::value& value, const std::string& key) const;
  [[noreturn]] void expected(const char* what) const;

  const boost::json::value* value_;
  const std::string* file_;
  std::string pointer_;
};

}  // namespace hauberk::detail
