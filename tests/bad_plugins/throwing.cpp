// A shape that loads, and misbehaves in the call its section names: {"where": "make" | ..., "how": "std" |
// ...}.
#include <hauberk/error.hpp>
#include <hauberk/plugin.hpp>

#include <unistd.h>
#include <cfenv>
#include <clocale>
#include <iostream>
#include <locale>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace hauberk {
namespace {

void misbehave(const std::string& how)
{
  if (how == "std") throw std::runtime_error("the dog ate it");
  if (how == "int") throw 42;
  if (how == "input") throw InputError("ring.R: 3 is too small");
  if (how == "computation") throw ComputationError("no convergence");
  if (how == "plugin") throw PluginError("shape: 2 sizes expected");
  if (how == "directory" && chdir("/") != 0) throw std::runtime_error("no root");
  if (how == "locale") std::setlocale(LC_ALL, "C.UTF-8");
  if (how == "precision") std::cout.precision(3);
  if (how == "directory_and_throw") {
    if (chdir("/") == 0) throw std::runtime_error("the dog ate it");
  }
  if (how == "rounding") std::fesetround(FE_UPWARD);
  if (how == "rounding_and_throw") {
    std::fesetround(FE_UPWARD);
    throw std::runtime_error("the dog ate it");
  }
#if defined(__x86_64__)
  if (how == "flush_to_zero") _mm_setcsr(_mm_getcsr() | (1U << 15));
#endif
}

class Throwing final : public Shape {
 public:
  Throwing(std::string where, std::string how) : where_(std::move(where)), how_(std::move(how)) {}

 protected:
  const std::vector<ParameterInfo>& do_parameters() const override
  {
    at("parameters");
    return parameters_;
  }
  void do_primitives(std::span<const double>, std::vector<Primitive>& out) const override
  {
    at("primitives");
    Primitive ring;
    ring.name = "ring";
    ring.size = {5.0, 0.5, 0.5};
    out = {ring};
  }
  void do_jacobians(std::span<const double>, std::vector<PrimitiveJacobian>& out) const override
  {
    at("jacobians");
    out.assign(1, PrimitiveJacobian{});
  }

 private:
  void at(const char* where) const
  {
    if (where_ == where) misbehave(how_);
  }

  std::string where_, how_;
  std::vector<ParameterInfo> parameters_;
};

void fields(std::vector<Field>&) { throw std::runtime_error("no fields today"); }

std::unique_ptr<Shape> make(const Node& section, Problems& problems)
{
  const std::string where = section.at("where").string;
  const std::string how = section.at("how").string;
  if (where == "make") misbehave(how);
  if (how == "null") return nullptr;
  if (how == "problem") problems.add(section, "expected something else");
  return std::make_unique<Throwing>(where, how);
}

}  // namespace
}  // namespace hauberk

extern "C" HAUBERK_EXPORT constinit const hauberk::PluginTable hauberk_plugin{HAUBERK_HANDSHAKE,
                                                                              hauberk::PluginKind::shape,
                                                                              "throwing",
                                                                              "1.0",
                                                                              "Misbehaves on demand.",
                                                                              "none",
                                                                              hauberk::fields,
                                                                              hauberk::make,
                                                                              nullptr,
                                                                              nullptr};
