#pragma once
/// A function of Python as an optimizer.

#include <hauberk/optimizer.hpp>

#include <pybind11/pybind11.h>

#include <memory>

namespace hauberk {

/// Calls `function` with the problem that is to be minimised (class Problem of the module), its first iterate
/// accepted. The function returns the best point, or None for the best that it accepted. What it throws ends
/// the run as it is. Lives and dies with Python's lock held; `minimize` takes it.
std::shared_ptr<const Optimizer> callback_optimizer(pybind11::function function);

/// Adds the class that such functions are given.
void bind_problem(pybind11::module_& m);

}  // namespace hauberk
