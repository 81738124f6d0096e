#pragma once
/// What a harness is: one function that must return, whatever the bytes are.

#include <cstddef>
#include <cstdint>

/// Called by libFuzzer, or by replay.cpp, once per input. Ends the program where a property does not hold.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
