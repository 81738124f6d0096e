#pragma once
/// What was done to a document: which part of the check looked at what, and how it ended there.

#include <hauberk/verify/verify.hpp>

#include <boost/json/value.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hauberk::verification {

class Record {
 public:
  /// A part of the check was done on everything below `scope` (a JSON pointer). Done more than once on the
  /// same scope it passes only when it does so every time.
  void done(VerifyPart part, const std::string& scope, bool passed);
  /// Everything below `pointer` was left out, whatever the rules say.
  void skip(const std::string& pointer, const std::string& why);
  /// The field at `pointer` is wrong by itself: missing, or of the wrong kind.
  void failed(const std::string& pointer);

  /// The outcome of every field of the document, in its order.
  std::vector<VerifyField> outcomes(const boost::json::value& document) const;

 private:
  std::map<std::pair<VerifyPart, std::string>, bool> done_;
  std::map<std::string, std::string> skipped_;
  std::map<std::string, bool> failed_;

  VerifyField outcome(const std::string& pointer) const;
  void collect(const boost::json::value& v, std::string& pointer, std::vector<VerifyField>& out) const;
};

}  // namespace hauberk::verification
