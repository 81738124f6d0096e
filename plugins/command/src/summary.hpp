#pragma once
/// What a finished run says.

#include "loading.hpp"

#include <hauberk/results.hpp>

#include <string>

namespace hauberk::command {

/// Tables of limits and of the design, and remarks on what is not an answer; several lines.
std::string summary(const Loaded& loaded, const RunResult& run);

/// True when some limit, or the design, has no answer (stalled, failed, interrupted).
bool any_failed(const RunResult& run);

}  // namespace hauberk::command
