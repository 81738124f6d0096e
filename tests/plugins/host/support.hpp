#pragma once
#include "temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <typeinfo>

namespace hauberk::test {

namespace fs = std::filesystem;

inline const fs::path bad_plugins = BAD_PLUGINS;

inline fs::path bad(const std::string& id) { return bad_plugins / (id + ".so"); }

/// The text of the exception of type Error that f throws; anything else is a failure.
template <class Error, class F>
std::string message_of(F&& f)
{
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "threw " << typeid(error).name() << ": " << error.what();
    return {};
  }
  ADD_FAILURE() << "threw nothing";
  return {};
}

}  // namespace hauberk::test
