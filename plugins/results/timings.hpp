#pragma once
/// What two runs of one experiment do not have alike, kept in a file of its own: timings.json, format
/// "hauberk-timings/1"; share/doc/results.md explains it. The times of a chart are its results and stay.

#include <boost/json/object.hpp>
#include <boost/json/value.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace hauberk {

inline constexpr const char* timings_format = "hauberk-timings/1";
/// Its name in a folder of results.
inline constexpr const char* timings_file = "timings.json";

/// Takes threads and memory out of the provenance of a results document, and every `seconds` out of what was
/// computed, and returns them as the document of timings.json. Members keep their order. Thread safe.
boost::json::object take_timings(boost::json::object& results);

/// Puts back what `take_timings` took, as far as the results have its place and it is a number that such a
/// place may hold; what is damaged is left out. Thread safe.
void enter_timings(boost::json::value& results, const boost::json::value& timings);

/// The results of a file, with what the file of timings beside it holds; without that file, or where it
/// cannot be read, results alone, and `lost` is told why it cannot. Throws InputError where the results
/// cannot be read.
boost::json::value read_timed_results(const std::filesystem::path& file,
                                      const std::function<void(const std::string&)>& lost);

}  // namespace hauberk
