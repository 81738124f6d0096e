#include "callback_optimizer.hpp"

#include "common/best_point.hpp"
#include "common/point.hpp"
#include "tasks/design/tapped_optimizer.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace hauberk {
namespace {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

Array copied(std::span<const double> x) { return Array(static_cast<py::ssize_t>(x.size()), x.data()); }

Array copied(std::span<const double> x, std::size_t columns)
{
  const std::size_t rows = columns == 0 ? 0 : x.size() / columns;
  return Array({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)}, x.data());
}

/// What an evaluation came to, as Python reads it.
struct Answer {
  bool ok;
  double value;
  Array gradient;
  std::string why;
};

/// What a function of Python may ask. Every question gives Python's lock away while it is answered.
class Problem {
 public:
  Problem(OptimizationProblem& problem, std::span<const double> start, OptimizerObserver& observer)
      : problem_(problem),
        observer_(observer),
        start_(start.begin(), start.end()),
        lower_(problem.lower().begin(), problem.lower().end()),
        upper_(problem.upper().begin(), problem.upper().end())
  {
  }

  Array start() const { return copied(start_); }
  Array lower() const { return copied(lower_); }
  Array upper() const { return copied(upper_); }
  int equality_count()
  {
    return asked([](OptimizationProblem& p) { return p.equality_count(); });
  }

  Answer evaluate(const Array& point)
  {
    const std::vector<double> x = within(point);
    return answer(asked([&](OptimizationProblem& p) { return p.evaluate(x, true); }));
  }

  std::vector<Answer> evaluate_many(const Array& points)
  {
    if (points.ndim() != 2) throw py::value_error("expected one point per row");
    std::vector<double> rows;
    for (py::ssize_t k = 0; k < points.shape(0); ++k) {
      const std::vector<double> x = within(Array(points[py::int_(k)]));
      rows.insert(rows.end(), x.begin(), x.end());
    }
    const auto count = static_cast<std::size_t>(points.shape(0));
    std::vector<Answer> out;
    for (OptimizationProblem::Evaluation& e :
         asked([&](OptimizationProblem& p) { return p.evaluate_batch(count, rows, true); }))
      out.push_back(answer(std::move(e)));
    return out;
  }

  /// At a point, which is evaluated where it was not the last one.
  std::optional<std::pair<Array, Array>> residuals(const Array& point)
  {
    const std::vector<double> x = within(point);
    std::vector<double> r, jacobian;
    const bool known = asked([&](OptimizationProblem& p) {
      r.resize(static_cast<std::size_t>(p.residual_count()));
      jacobian.resize(r.size() * x.size());
      return !r.empty() && p.evaluate(x, false).ok && p.residuals(x, r, jacobian);
    });
    if (!known) return std::nullopt;
    return std::pair(copied(r), copied(jacobian, x.size()));
  }

  std::pair<Array, Array> constraints(const Array& point)
  {
    const std::vector<double> x = sized(point);
    std::vector<double> c, jacobian;
    asked([&](OptimizationProblem& p) {
      c.resize(static_cast<std::size_t>(p.constraint_count()));
      jacobian.resize(c.size() * x.size());
      if (!c.empty()) p.constraints(x, c, jacobian);
      return true;
    });
    return {copied(c), copied(jacobian, x.size())};
  }

  double safe_step(const Array& point, const Array& direction)
  {
    const std::vector<double> x = sized(point), d = sized(direction);
    return asked([&](OptimizationProblem& p) { return p.largest_safe_step(x, d); });
  }

  /// Makes a point the iterate and tells the observer; false: stop.
  bool accept(const Array& point, double step)
  {
    const std::vector<double> x = within(point);
    if (!std::isfinite(step)) throw py::value_error("expected a finite step");
    return asked([&](OptimizationProblem& p) {
      const double tried = value_at(p, x);
      p.accept(x);
      const double value = value_at(p, x), violation = violation_at(p, x);
      best_.looked_again(tried, value);
      best_.offer(vector_of(x), value, violation);
      go_on_ = observer_.on_iterate({iterations_, value, step, violation, 0.0, x});
      ++iterations_;
      return go_on_;
    });
  }

  /// What the function comes to, and the end of questions.
  OptimizerResult end(const py::object& returned)
  {
    close();
    if (!returned.is_none()) {
      const std::vector<double> x = within(Array(returned));
      best_ = BestPoint(feasible);
      ++evaluations_;
      answered([&](OptimizationProblem& p) {
        const double value = value_at(p, x);
        return best_.offer(vector_of(x), value, violation_at(p, x));
      });
    }
    OptimizerResult out =
        best_.result(go_on_ ? "converged" : "stopped",
                     go_on_ ? "the function ended" : "stopped by the observer", vector_of(start_), 0.0);
    out.iterations = std::max(0, iterations_ - 1);
    out.evaluations = evaluations_;
    return out;
  }

  /// No more questions; one that another thread asks is answered before this returns.
  void close()
  {
    closed_ = true;
    while (busy_) {
      const py::gil_scoped_release free;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  bool interrupted() const { return interrupted_; }

 private:
  /// Violations below this count as none, L.
  static constexpr double feasible = 1e-9;

  template <class Question>
  auto asked(const Question& question) -> decltype(question(std::declval<OptimizationProblem&>()))
  {
    if (closed_) throw std::runtime_error("this minimisation is over: its problem answers no more");
    return answered(question);
  }

  template <class Question>
  auto answered(const Question& question) -> decltype(question(std::declval<OptimizationProblem&>()))
  {
    if (busy_) throw std::runtime_error("a problem answers one question at a time");
    if (interrupted_) interrupt();
    busy_ = true;
    try {
      auto out = [&] {
        const py::gil_scoped_release free;
        return question(problem_);
      }();
      busy_ = false;
      return out;
    } catch (const SearchInterrupted&) {
      busy_ = false;
      interrupted_ = true;
    } catch (...) {
      busy_ = false;
      throw;
    }
    interrupt();
  }

  [[noreturn]] static void interrupt()
  {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }

  static Eigen::VectorXd vector_of(const std::vector<double>& x)
  {
    return Eigen::Map<const Eigen::VectorXd>(x.data(), std::ssize(x));
  }

  /// Of an iterate or a result: what cannot be evaluated is neither.
  static double value_at(OptimizationProblem& p, const std::vector<double>& x)
  {
    const OptimizationProblem::Evaluation at = p.evaluate(x, false);
    if (!at.ok)
      throw py::value_error("a point that cannot be evaluated is no iterate and no result: " + at.why);
    return at.value;
  }

  static double violation_at(OptimizationProblem& p, const std::vector<double>& x)
  {
    Eigen::VectorXd c(p.constraint_count());
    if (c.size() > 0) p.constraints(x, {c.data(), static_cast<std::size_t>(c.size())}, {});
    return largest_violation(c, p.equality_count());
  }

  std::vector<double> sized(const Array& point) const
  {
    if (point.ndim() != 1 || static_cast<std::size_t>(point.size()) != start_.size())
      throw py::value_error(fmt::format("expected {} numbers, one per variable", start_.size()));
    std::vector<double> x(point.data(), point.data() + point.size());
    if (!std::all_of(x.begin(), x.end(), [](double c) { return std::isfinite(c); }))
      throw py::value_error("expected finite numbers");
    return x;
  }

  std::vector<double> within(const Array& point) const
  {
    std::vector<double> x = sized(point);
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (!(x[k] >= lower_[k] && x[k] <= upper_[k]))
        throw py::value_error(
            fmt::format("variable {} is {}, outside its bounds {} and {}", k, x[k], lower_[k], upper_[k]));
    }
    return x;
  }

  Answer answer(OptimizationProblem::Evaluation e)
  {
    ++evaluations_;
    return {e.ok, e.ok ? e.value : std::numeric_limits<double>::infinity(), copied(e.gradient),
            std::move(e.why)};
  }

  OptimizationProblem& problem_;  ///< alive until `closed_`
  OptimizerObserver& observer_;
  std::vector<double> start_, lower_, upper_;
  BestPoint best_{feasible};
  int iterations_ = 0, evaluations_ = 0;
  /// Read and written with Python's lock held.
  bool closed_ = false, busy_ = false, interrupted_ = false, go_on_ = true;
};

class CallbackOptimizer final : public Optimizer {
 public:
  explicit CallbackOptimizer(py::function function) : function_(std::move(function)) {}
  OptimizerTraits traits() const override { return {.equalities = true}; }

 protected:
  OptimizerResult do_minimize(OptimizationProblem& problem, std::span<const double> start,
                              OptimizerObserver& observer) const override
  {
    const py::gil_scoped_acquire lock;
    const auto asked = std::make_shared<Problem>(problem, start, observer);
    try {
      const Array x0 = asked->start();
      if (const Answer first = asked->evaluate(x0); !first.ok)
        return {"failed", "the start cannot be evaluated: " + first.why, {start.begin(), start.end()}, 0.0, 0,
                1};
      const py::object returned = asked->accept(x0, 0.0) ? function_(asked) : py::none();
      return asked->end(returned);
    } catch (...) {
      asked->close();
      if (asked->interrupted()) throw SearchInterrupted{};
      throw;
    }
  }

 private:
  py::function function_;
};

}  // namespace

std::shared_ptr<const Optimizer> callback_optimizer(py::function function)
{
  return std::make_shared<const CallbackOptimizer>(std::move(function));
}

void bind_problem(py::module_& m)
{
  py::class_<Answer>(m, "Evaluation", "What an evaluation came to.")
      .def_readonly("ok", &Answer::ok, "False: the point could not be evaluated.")
      .def_readonly("value", &Answer::value,
                    "The objective; infinite where the point could not be evaluated.")
      .def_readonly("gradient", &Answer::gradient)
      .def_readonly("why", &Answer::why, "Why it could not be evaluated.");
  py::class_<Problem, std::shared_ptr<Problem>>(
      m, "Problem",
      "What a design minimises: given to the function that Experiment.run(optimizer=...) calls.")
      .def_property_readonly("start", &Problem::start, "Where the search begins; it is the first iterate.")
      .def_property_readonly("lower", &Problem::lower)
      .def_property_readonly("upper", &Problem::upper)
      .def_property_readonly("equality_count", &Problem::equality_count,
                             "How many of the constraints, the first ones, are equations.")
      .def("evaluate", &Problem::evaluate, py::arg("x"),
           "Objective and gradient at x, which the last accepted point must lead to by a safe step.")
      .def("evaluate_many", &Problem::evaluate_many, py::arg("points"),
           "The same for every row of an array, on all threads.")
      .def("residuals", &Problem::residuals, py::arg("x"),
           "(r, J) with objective r.r/2 and J = dr/dx at x; None where they are not known.")
      .def("constraints", &Problem::constraints, py::arg("x"),
           "(c, J): c >= 0, but for the equations, and dc/dx.")
      .def("safe_step", &Problem::safe_step, py::arg("x"), py::arg("d"),
           "Largest share of the step d from the last accepted point x on which nothing collides.")
      .def("accept", &Problem::accept, py::arg("x"), py::arg("step") = 1.0,
           "Makes x, just evaluated, the iterate that searches go on from, and reports it. False: stop now.");
}

}  // namespace hauberk
