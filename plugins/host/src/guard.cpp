#include <hauberk/error.hpp>
#include <hauberk/host/guard.hpp>

#include <fmt/format.h>

#include <cxxabi.h>
#include <exception>

namespace hauberk {

void Guard::throw_mode_changed(const char* call, const FloatingPointMode& before,
                               const FloatingPointMode& after) const
{
  throw PluginError(
      fmt::format("plugin '{}': {} changed the floating-point mode ({}); it was restored, but what the call "
                  "computed cannot be used",
                  plugin_, call, describe_change(before, after)));
}

void Guard::restore_state(const char* call, const ProcessState& before) const
{
  const std::string changed = before.restore();
  if (changed.empty()) return;
  throw PluginError(fmt::format(
      "plugin '{}': {} changed the state of the process ({}); it was restored, but a plugin must leave it alone",
      plugin_, call, changed));
}

void Guard::rethrow(const char* call) const
{
  try {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const ComputationError&) {
    throw;
  } catch (const abi::__forced_unwind&) {
    throw;  // the thread is being cancelled; swallowing this ends the program
  } catch (const std::exception& error) {
    throw PluginError(fmt::format("plugin '{}': {} failed: {}", plugin_, call, error.what()));
  } catch (...) {
    throw PluginError(
        fmt::format("plugin '{}': {} failed: it threw something that is no std::exception", plugin_, call));
  }
}

}  // namespace hauberk
