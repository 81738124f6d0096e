#include "numerics/on_demand.hpp"

#include <fmt/format.h>

#include <dlfcn.h>
#include <stdexcept>
#include <string>

namespace hauberk {

void* on_demand(const char* library, const char* function)
{
  Dl_info kernel;
  if (::dladdr(reinterpret_cast<const void*>(&on_demand), &kernel) == 0 || kernel.dli_fname == nullptr)
    throw std::runtime_error("the kernel's library does not know where it lies");
  std::string path = kernel.dli_fname;
  const std::size_t name = path.rfind('/');
  path = fmt::format("{}hauberk/on_demand/{}.so", name == std::string::npos ? "" : path.substr(0, name + 1),
                     library);
  void* handle = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* found = handle == nullptr ? nullptr : ::dlsym(handle, function);
  if (found == nullptr) {
    const char* why = ::dlerror();
    throw std::runtime_error(
        fmt::format("{} cannot be loaded: {}; it is a part of this program: install it again", path,
                    why == nullptr ? "no reason is told" : why));
  }
  return found;
}

}  // namespace hauberk
