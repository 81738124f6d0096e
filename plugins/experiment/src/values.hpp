#pragma once
/// Named values: numbers that an experiment names once, and strings such as "$pitch/2" that stand for
/// numbers. They are put into the tree before anything else reads it, so that everything after knows numbers
/// only.

#include <hauberk/section.hpp>

#include <utility>
#include <vector>

namespace hauberk {

/// values.
Field values_field();

/// The strings that were replaced by numbers, with their pointers.
using WrittenValues = std::vector<std::pair<std::string, Node>>;

/// Replaces every string of the tree that begins with "$", or with "=" that is not read, by the number that
/// it comes to; the section `values` keeps its names, with numbers. Not touched: what a key `name` has,
/// description,
/// `$schema` and `expect`. Mistakes are reported.
///
/// expression = term {(+ | -) term}, term = factor {(* | /) factor}, factor = [-] power, power = atom [^
/// factor], atom = number | $name | pi | (expression) | f(expression), f = sqrt, sin, cos, tan, asin, acos,
/// atan; angles in degrees.
WrittenValues put_values(Node& root, Problems& problems);

/// Puts the strings back where there still is a number, but in `values` sections of tasks that make variants,
/// whose names are given: variants begin from what is written.
void keep_values(Node& root, const WrittenValues& written, const std::vector<std::string>& not_within);

}  // namespace hauberk
