#include "document/record_line.hpp"

#include <fmt/format.h>
#include <boost/crc.hpp>

#include <utility>

namespace hauberk {
namespace {

/// CRC-32 of a line up to here, as the line has it.
std::string checksum(std::string_view text)
{
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format(" {:08x}", crc.checksum());
}

}  // namespace

void RecordWriter::numbers(std::span<const double> x)
{
  number(x.size());
  for (const double v : x) number(v);
}

void RecordWriter::words(std::string_view s)
{
  text_ += " '";
  for (const char c : s) {
    if (c <= ' ' || c == '%')
      text_ += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    else
      text_ += c;
  }
}

std::string RecordWriter::line() && { return record_line(std::move(text_)); }

std::string record_line(std::string text)
{
  text += checksum(text);
  return std::move(text.append(end_of_record));
}

std::size_t RecordReader::count()
{
  const auto n = number<std::size_t>();
  good = good && n <= text_.size();
  return good ? n : 0;
}

std::vector<double> RecordReader::numbers()
{
  std::vector<double> x(count());
  for (double& v : x) v = number<double>();
  return x;
}

std::string RecordReader::words()
{
  const std::string_view word = next();
  good = good && word.starts_with('\'');
  std::string s;
  for (std::size_t i = 1; good && i < word.size(); ++i) {
    if (word[i] != '%') {
      s += word[i];
      continue;
    }
    unsigned code = 0;
    good = i + 2 < word.size() &&
           std::from_chars(word.data() + i + 1, word.data() + i + 3, code, 16).ec == std::errc{};
    s += static_cast<char>(code);
    i += 2;
  }
  return good ? s : std::string();
}

std::string_view RecordReader::next()
{
  const std::size_t begin = text_.find_first_not_of(' ');
  if (begin == std::string_view::npos) {
    good = false;
    return {};
  }
  text_.remove_prefix(begin);
  const std::string_view word = text_.substr(0, text_.find(' '));
  text_.remove_prefix(word.size());
  return word;
}

std::optional<std::string_view> undamaged_record(std::string_view line)
{
  constexpr std::size_t sum_length = 9;
  if (!line.ends_with(end_of_record)) return std::nullopt;
  line.remove_suffix(end_of_record.size());
  if (line.size() <= sum_length) return std::nullopt;
  const std::string_view text = line.substr(0, line.size() - sum_length);
  if (checksum(text) != line.substr(text.size())) return std::nullopt;
  return text;
}

}  // namespace hauberk
