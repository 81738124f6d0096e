#pragma once
/// Changes of single fields of a document, and what the check makes of each.

#include <hauberk/verify/verify.hpp>

#include <boost/json/value.hpp>

#include <string>
#include <vector>

namespace hauberk::test {

/// How many fields of a document the check notices when they are changed.
struct MutationCounts {
  std::size_t fields = 0;              ///< of the document
  std::size_t tried = 0;               ///< changed, one at a time
  std::size_t caught = 0;              ///< the check fails
  std::size_t listed = 0;              ///< the check passes, and says that the field is not checked
  std::vector<std::string> missed;     ///< neither
  std::vector<std::string> pretended;  ///< said to fail or to pass by a document that nothing is wrong with
};

/// Another value: a number a thousandth larger (an integer by 1), a text with a letter more, the opposite of
/// true and false, 1 instead of null. Numbers near zero change by what matters beside their neighbours,
/// `least`.
boost::json::value other(const boost::json::value& v, double least);

/// Changes fields of a true document one at a time. Of those with the same pattern `most` are taken, evenly
/// over the document. `shapes` know the surfaces of solids.
MutationCounts mutate(const boost::json::value& document, std::size_t most, const VerifyShapes& shapes = {});

}  // namespace hauberk::test
