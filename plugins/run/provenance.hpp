#pragma once
/// Where results come from, and whether two results have one origin.

#include "run/prepared.hpp"

#include <boost/json/value.hpp>

namespace hauberk {

/// What computes results in this build. With `machine` times are the result, so that the machine belongs to
/// it.
Provenance provenance(const Prepared& prepared, unsigned threads, bool machine);

/// On one line: results of one identity are the same.
std::string identity(const Prepared& prepared, const Provenance& provenance);

/// Throws InputError where `document` (a results file) has another format, or was computed from another
/// experiment or by another version of the program: results of both in one file would not say where they come
/// from.
void check_origin(const boost::json::value& document, const Prepared& prepared);

}  // namespace hauberk
