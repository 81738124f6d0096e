#pragma once
/// Wrappers that own an object made by a plugin and guard each call into it.

#include <hauberk/host/guard.hpp>
#include <hauberk/load_case.hpp>
#include <hauberk/optimizer.hpp>
#include <hauberk/plugin.hpp>
#include <hauberk/shape.hpp>

#include <memory>

namespace hauberk {

std::unique_ptr<Shape> guard_shape(std::unique_ptr<Shape> shape, const Guard& guard);
std::unique_ptr<LoadCase> guard_load_case(std::unique_ptr<LoadCase> load_case, const Guard& guard);
/// Runs of an optimizer that is not thread safe wait for those of all such optimizers of the library that has
/// `table`.
std::unique_ptr<Optimizer> guard_optimizer(std::unique_ptr<Optimizer> optimizer, const Guard& guard,
                                           const PluginTable& table);

}  // namespace hauberk
