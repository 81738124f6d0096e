#pragma once
/// Named values: numbers that an experiment names once, and strings such as "$pitch/2" that stand for
/// numbers. They are put into the tree before anything else reads it, so that everything after knows numbers
/// only.

#include <hauberk/section.hpp>

namespace hauberk {

/// values.
Field values_field();

/// Replaces every string of the tree that begins with "$", or with "=" that is not read, by the number that
/// it comes to; the section `values` keeps its names, with numbers. Not touched: what a key `name` has,
/// description,
/// `$schema` and `expect`. Mistakes are reported.
///
/// expression = term {(+ | -) term}, term = factor {(* | /) factor}, factor = [-] power, power = atom [^
/// factor], atom = number | $name | pi | (expression) | f(expression), f = sqrt, sin, cos, tan, asin, acos,
/// atan; angles in degrees.
void put_values(Node& root, Problems& problems);

/// Puts the strings of `written` back where the tree has the numbers that they came to: variants begin from
/// what is written.
void keep_values(Node& expanded, const Node& written);

}  // namespace hauberk
