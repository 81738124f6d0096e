#include "run/code_digest.hpp"

#include "limits/limits.hpp"
#include "run/sha256.hpp"

#include <link.h>
#include <cstdint>
#include <string_view>

namespace hauberk {
namespace {

/// Whether an object has an address in one of its segments.
bool holds(const dl_phdr_info& object, std::uintptr_t address)
{
  for (int k = 0; k < object.dlpi_phnum; ++k) {
    const ElfW(Phdr)& segment = object.dlpi_phdr[k];
    const std::uintptr_t begin = object.dlpi_addr + segment.p_vaddr;
    if (segment.p_type == PT_LOAD && address >= begin && address < begin + segment.p_memsz) return true;
  }
  return false;
}

int add_segments(dl_phdr_info* object, std::size_t /*size*/, void* data)
{
  const auto here = reinterpret_cast<std::uintptr_t>(&code_digest);
  const auto kernel = reinterpret_cast<std::uintptr_t>(&compute_limits);
  if (!holds(*object, here) && !holds(*object, kernel)) return 0;
  for (int k = 0; k < object->dlpi_phnum; ++k) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[k];
    if (segment.p_type != PT_LOAD || (segment.p_flags & (PF_R | PF_W)) != PF_R) continue;
    const auto* begin = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
    static_cast<Sha256*>(data)->add(std::string_view(begin, segment.p_filesz));
  }
  return 0;
}

}  // namespace

std::string code_digest()
{
  Sha256 hash;
  ::dl_iterate_phdr(add_segments, &hash);
  return hash.digest();
}

}  // namespace hauberk
