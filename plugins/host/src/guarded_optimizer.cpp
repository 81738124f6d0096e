#include "guarded.hpp"

#include <dlfcn.h>
#include <exception>
#include <map>
#include <mutex>

namespace hauberk {
namespace {

/// Remembers the first exception that left the program's side of a callback, so that it is not mistaken for
/// one of the plugin's, nor lost when the plugin swallows it.
class Callbacks {
 public:
  template <class F>
  auto run(F&& f) -> decltype(f())
  {
    try {
      return f();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
      throw;
    }
  }

  void rethrow_if_any() const
  {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr thrown_;
};

/// One for each library in which runs wait for each other: what such a library keeps in global variables
/// belongs to the whole process, as it is loaded once, and so must the lock. Recursive, as the problem of a
/// run may itself start one.
std::recursive_mutex& lock_of_library(const PluginTable& table)
{
  static std::mutex mutex;
  static std::map<const void*, std::recursive_mutex> locks;
  Dl_info library{};
  const void* base = ::dladdr(&table, &library) != 0 ? library.dli_fbase : &table;
  const std::lock_guard lock(mutex);
  return locks[base];
}

class WatchedProblem final : public OptimizationProblem {
 public:
  WatchedProblem(OptimizationProblem& inner, Callbacks& callbacks) : inner_(inner), callbacks_(callbacks) {}

  std::span<const double> lower() const override
  {
    return callbacks_.run([&] { return inner_.lower(); });
  }
  std::span<const double> upper() const override
  {
    return callbacks_.run([&] { return inner_.upper(); });
  }
  int constraint_count() const override
  {
    return callbacks_.run([&] { return inner_.constraint_count(); });
  }
  int equality_count() const override
  {
    return callbacks_.run([&] { return inner_.equality_count(); });
  }
  Evaluation evaluate(std::span<const double> x, bool want_gradient) override
  {
    return callbacks_.run([&] { return inner_.evaluate(x, want_gradient); });
  }
  std::vector<Evaluation> evaluate_batch(std::size_t count, std::span<const double> points,
                                         bool want_gradient) override
  {
    return callbacks_.run([&] { return inner_.evaluate_batch(count, points, want_gradient); });
  }
  int residual_count() const override
  {
    return callbacks_.run([&] { return inner_.residual_count(); });
  }
  bool residuals(std::span<const double> x, std::span<double> r, std::span<double> jacobian) override
  {
    return callbacks_.run([&] { return inner_.residuals(x, r, jacobian); });
  }
  void constraints(std::span<const double> x, std::span<double> c, std::span<double> jacobian) override
  {
    callbacks_.run([&] { inner_.constraints(x, c, jacobian); });
  }
  bool hessian_product(std::span<const double> x, double weight, std::span<const double> multipliers,
                       std::span<const double> v, std::span<double> out) override
  {
    return callbacks_.run([&] { return inner_.hessian_product(x, weight, multipliers, v, out); });
  }
  double largest_safe_step(std::span<const double> x, std::span<const double> d) override
  {
    return callbacks_.run([&] { return inner_.largest_safe_step(x, d); });
  }
  void accept(std::span<const double> x) override
  {
    callbacks_.run([&] { inner_.accept(x); });
  }
  std::uint64_t stream() const override
  {
    return callbacks_.run([&] { return inner_.stream(); });
  }

 private:
  OptimizationProblem& inner_;
  Callbacks& callbacks_;
};

class WatchedObserver final : public OptimizerObserver {
 public:
  WatchedObserver(OptimizerObserver& inner, Callbacks& callbacks) : inner_(inner), callbacks_(callbacks) {}

  bool on_iterate(const OptimizerIterate& iterate) override
  {
    return callbacks_.run([&] { return inner_.on_iterate(iterate); });
  }

 private:
  OptimizerObserver& inner_;
  Callbacks& callbacks_;
};

class GuardedOptimizer final : public Optimizer {
 public:
  GuardedOptimizer(std::unique_ptr<Optimizer> inner, const Guard& guard, const PluginTable& table)
      : inner_(std::move(inner)),
        guard_(guard),
        traits_(guard_.with_process_state("traits", [&] { return inner_->traits(); })),
        alone_(traits_.thread_safe ? nullptr : &lock_of_library(table))
  {
  }

  OptimizerTraits traits() const override { return traits_; }

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override
  {
    std::unique_lock<std::recursive_mutex> lock;
    if (alone_ != nullptr) lock = std::unique_lock(*alone_);
    Callbacks callbacks;
    WatchedProblem watched_problem(problem, callbacks);
    WatchedObserver watched_observer(observer, callbacks);
    try {
      OptimizerResult result = guard_.with_process_state(
          "minimize", [&] { return inner_->minimize(watched_problem, start, watched_observer); });
      callbacks.rethrow_if_any();
      return result;
    } catch (...) {
      callbacks.rethrow_if_any();
      throw;
    }
  }

 private:
  std::unique_ptr<Optimizer> inner_;
  Guard guard_;
  OptimizerTraits traits_;
  std::recursive_mutex* alone_;  ///< held during a run; null: runs need not wait for each other
};

}  // namespace

std::unique_ptr<Optimizer> guard_optimizer(std::unique_ptr<Optimizer> optimizer, const Guard& guard,
                                           const PluginTable& table)
{
  return std::make_unique<GuardedOptimizer>(std::move(optimizer), guard, table);
}

}  // namespace hauberk
