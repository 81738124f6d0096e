#pragma once
/// Runs calls into a plugin so that nothing but its result, or an error with its name, comes back.

#include <hauberk/host/floating_point.hpp>
#include <hauberk/host/process_state.hpp>

#include <string>
#include <type_traits>
#include <utility>

namespace hauberk {

/// Wraps calls into one plugin. Immutable, thread safe.
///
/// - InputError and ComputationError pass through: plugins may report those.
/// - Any other exception, of std or not, becomes PluginError "plugin 'ID': CALL failed: ...".
/// - The floating-point mode is restored. A call that changed it is an error even if it returned: what it
///   computed was not rounded as the rest of the program relies on.
/// - Of calls that are in no loop, `with_process_state`, the state of the process is restored, too, and a
/// call
///   that changed it is an error. The conformance kit looks for such changes by all other calls.
class Guard {
 public:
  explicit Guard(std::string plugin) : plugin_(std::move(plugin)) {}

  /// Returns f(), called as `call` in messages.
  template <class F>
  std::invoke_result_t<F> operator()(const char* call, F&& f) const
  {
    using Result = std::invoke_result_t<F>;
    const FloatingPointMode before = floating_point_mode();
    const auto run = [&]() -> Result {
      try {
        return std::forward<F>(f)();
      } catch (...) {
        set_floating_point_mode(before);
        rethrow(call);
      }
    };
    if constexpr (std::is_void_v<Result>) {
      run();
      restore_mode(call, before);
    } else {
      Result result = run();
      restore_mode(call, before);
      return result;
    }
  }

  /// As operator(), and keeps the state of the process, which costs about a microsecond.
  template <class F>
  std::invoke_result_t<F> with_process_state(const char* call, F&& f) const
  {
    using Result = std::invoke_result_t<F>;
    const ProcessState before;
    const auto run = [&]() -> Result {
      try {
        return (*this)(call, std::forward<F>(f));
      } catch (...) {
        before.restore();
        throw;
      }
    };
    if constexpr (std::is_void_v<Result>) {
      run();
      restore_state(call, before);
    } else {
      Result result = run();
      restore_state(call, before);
      return result;
    }
  }

  const std::string& plugin() const { return plugin_; }

 private:
  void restore_mode(const char* call, const FloatingPointMode& before) const
  {
    const FloatingPointMode after = floating_point_mode();
    if (after == before) return;
    set_floating_point_mode(before);
    throw_mode_changed(call, before, after);
  }
  [[noreturn]] void throw_mode_changed(const char* call, const FloatingPointMode& before,
                                       const FloatingPointMode& after) const;
  void restore_state(const char* call, const ProcessState& before) const;
  /// Translates the exception in flight.
  [[noreturn]] void rethrow(const char* call) const;

  std::string plugin_;
};

}  // namespace hauberk
