#pragma once
/// Which build this process is.

#include <string>

namespace hauberk {

/// SHA-256 of the machine code and constants of the program and of the library that computes, as they are in
/// memory: what is neither written to nor depends on where it was loaded. Equal for copies, different for
/// builds that differ in what they do. Empty where the system does not tell. Thread safe.
std::string code_digest();

}  // namespace hauberk
