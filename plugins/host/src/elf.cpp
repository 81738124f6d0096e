#include "elf.hpp"

#include <elf.h>
#include <link.h>
#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <optional>

namespace hauberk {
namespace {

using Header = ElfW(Ehdr);
using Section = ElfW(Shdr);
using Symbol = ElfW(Sym);
using Dynamic = ElfW(Dyn);

#if defined(__x86_64__)
constexpr unsigned machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr unsigned machine = EM_AARCH64;
#else
constexpr unsigned machine = EM_NONE;  // not told apart; dlopen decides
#endif

/// Reads arrays out of the file, bounded by its size.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : stream_(file, std::ios::binary | std::ios::ate)
  {
    if (stream_) size_ = static_cast<std::uint64_t>(stream_.tellg());
  }

  template <class T>
  std::optional<std::vector<T>> array(std::uint64_t offset, std::uint64_t count)
  {
    if (offset > size_ || count > (size_ - offset) / sizeof(T)) return std::nullopt;
    std::vector<T> values(count);
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
    if (!stream_) return std::nullopt;
    return values;
  }

  template <class T>
  std::optional<std::vector<T>> section(const Section& s)
  {
    return array<T>(s.sh_offset, s.sh_size / sizeof(T));
  }

 private:
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

std::string text(const std::vector<char>& table, std::uint64_t offset)
{
  if (offset >= table.size()) return {};
  const char* begin = table.data() + offset;
  return {begin, strnlen(begin, table.size() - offset)};
}

/// Fills the lists of `summary` from one section; false if the file ends before it does.
bool read_section(Reader& reader, const Section& s, const Section& strings_section, ElfSummary& summary)
{
  const auto strings = reader.section<char>(strings_section);
  if (!strings) return false;
  if (s.sh_type == SHT_DYNSYM) {
    const auto symbols = reader.section<Symbol>(s);
    if (!symbols) return false;
    for (const Symbol& symbol : *symbols) {
      if (symbol.st_shndx != SHN_UNDEF) summary.exported.push_back(text(*strings, symbol.st_name));
    }
    summary.tables = true;
    return true;
  }
  const auto entries = reader.section<Dynamic>(s);
  if (!entries) return false;
  for (const Dynamic& entry : *entries) {
    if (entry.d_tag == DT_NEEDED) summary.needed.push_back(text(*strings, entry.d_un.d_val));
    if (entry.d_tag == DT_INIT_ARRAYSZ) summary.constructors = entry.d_un.d_val / sizeof(void*);
  }
  return true;
}

/// False if the file is damaged. A file without sections is not: they are not needed to load it.
bool read_sections(Reader& reader, const Header& header, ElfSummary& summary)
{
  if (header.e_shnum == 0) return true;
  if (header.e_shentsize != sizeof(Section)) return false;
  const auto sections = reader.array<Section>(header.e_shoff, header.e_shnum);
  if (!sections) return false;
  return std::all_of(sections->begin(), sections->end(), [&](const Section& s) {
    if (s.sh_type != SHT_DYNSYM && s.sh_type != SHT_DYNAMIC) return true;
    return s.sh_link < sections->size() && read_section(reader, s, (*sections)[s.sh_link], summary);
  });
}

}  // namespace

ElfSummary read_elf(const std::filesystem::path& file)
{
  ElfSummary summary;
  Reader reader(file);
  const auto ident = reader.array<unsigned char>(0, EI_NIDENT);
  if (!ident || std::memcmp(ident->data(), ELFMAG, SELFMAG) != 0) return summary;
  summary.elf = true;

  constexpr unsigned char word = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  constexpr unsigned char order = std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;
  if ((*ident)[EI_CLASS] != word || (*ident)[EI_DATA] != order) return summary;
  const auto header = reader.array<Header>(0, 1);
  summary.damaged = !header;
  if (summary.damaged) return summary;
  summary.this_machine = machine == EM_NONE || header->front().e_machine == machine;
  if (summary.this_machine) summary.damaged = !read_sections(reader, header->front(), summary);
  return summary;
}

}  // namespace hauberk
