#include "text_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace hauberk::detail {
namespace {

constexpr std::size_t longest_quote = 24;

}  // namespace

std::string read_bytes(const std::string& path, int megabytes)
{
  const auto refuse = [&path](const std::string& why) {
    throw InputError(fmt::format("{}: cannot be read: {}", path, why));
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    refuse("there is no such file; paths are relative to the experiment's folder");
  if (!std::filesystem::is_regular_file(status)) refuse("it is not a regular file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(errno != 0 ? std::generic_category().message(errno) : "it cannot be opened");
  std::string bytes, block(1 << 16, '\0');
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    bytes.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (static_cast<std::streamsize>(bytes.size()) > static_cast<std::streamsize>(megabytes) << 20)
      refuse(fmt::format("it is larger than {} MB", megabytes));
  }
  if (file.bad()) refuse("reading failed");
  return bytes;
}

std::string ending_of(const std::string& path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool read_number(std::string_view word, double& value)
{
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

std::string_view next_word(std::string_view& line)
{
  constexpr std::string_view blanks = " \t\r\f\v";
  const std::size_t begin = std::min(line.find_first_not_of(blanks), line.size());
  line.remove_prefix(begin);
  const std::size_t end = std::min(line.find_first_of(blanks), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

std::string_view next_line(std::string_view& text)
{
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::string quoted(std::string_view word)
{
  std::string out = "'";
  for (const char c : word.substr(0, longest_quote))
    out += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
  return out + (word.size() > longest_quote ? "...'" : "'");
}

}  // namespace hauberk::detail
