#pragma once
/// Numbers in the words of a command line.

#include "options.hpp"

#include <string>
#include <vector>

namespace hauberk::command {

/// Numbers between commas, all of the text; empty: it is something else.
std::vector<double> numbers_in(const std::string& text);

/// Whole numbers between commas, from 1 to `most`, of an option. Throws UsageError with the example.
std::vector<int> counts_of(const Options& options, const char* name, int most, const char* example);

/// A number above 0 of an option; 0 where it is not given. Throws UsageError.
double positive(const Options& options, const char* name);

}  // namespace hauberk::command
