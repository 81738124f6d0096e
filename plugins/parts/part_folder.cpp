#include "parts/part_folder.hpp"

#include "document/atomic_file.hpp"
#include "document/json_text.hpp"
#include "document/json_values.hpp"
#include "document/json_writer.hpp"
#include "document/read_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/json/object.hpp>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

namespace hauberk {
namespace {

namespace fs = std::filesystem;
namespace json = boost::json;

std::optional<std::size_t> number_in(std::string_view text)
{
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(n) : std::nullopt;
}

json::array texts(const std::vector<std::string>& list)
{
  json::array out;
  for (const std::string& text : list) out.emplace_back(text);
  return out;
}

std::vector<std::string> texts(const json::value& list)
{
  std::vector<std::string> out;
  for (const json::value& text : list.as_array()) out.push_back(text_of(text));
  return out;
}

json::object division_json(const Division& d)
{
  return {{"format", parts_format},     {"parts", d.count},    {"identity", d.identity},
          {"experiment", d.experiment}, {"set", texts(d.set)}, {"plugin_path", texts(d.libraries)}};
}

}  // namespace

Share share_named(const std::string& text)
{
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view all = text;
  const std::size_t number = number_in(all.substr(0, slash)).value_or(0);
  const std::size_t count = number_in(all.substr(std::min(text.size(), slash + 1))).value_or(0);
  if (number < 1 || number > count || count > most_parts)
    throw InputError(
        fmt::format("expected K/N, part K of N with 1 <= K <= N <= {}, found '{}'", most_parts, text));
  return {number - 1, count};
}

std::string part_name(const Share& share) { return fmt::format("{}-of-{}", share.index + 1, share.count); }

fs::path part_path(const fs::path& folder, const Share& share)
{
  return folder / parts_folder / part_name(share);
}

Division read_division(const fs::path& folder)
{
  const fs::path file = folder / parts_folder / parts_file;
  std::error_code unknown;
  if (!fs::exists(file, unknown))
    throw InputError(
        fmt::format("{}: holds no parts of a run; compute them with `hauberk run ... --part K/N -o {}`",
                    folder.string(), folder.string()));
  try {
    const json::value document = parse_json(read_whole_file(file.string(), largest_text), file.string());
    if (text_of(document.at("format")) != parts_format) throw InputError("it has another format");
    Division d;
    d.count = document.at("parts").to_number<std::size_t>();
    if (d.count < 1 || d.count > most_parts) throw InputError("its number of parts is none");
    d.identity = text_of(document.at("identity"));
    d.experiment = text_of(document.at("experiment"));
    d.set = texts(document.at("set"));
    d.libraries = texts(document.at("plugin_path"));
    return d;
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: is not what divided runs write ({}); remove the folder '{}' and compute "
                    "the parts anew",
                    file.string(), error.what(), (folder / parts_folder).string()));
  }
}

void enter_division(const fs::path& folder, const Division& division)
{
  const fs::path file = folder / parts_folder / parts_file;
  std::error_code unknown;
  if (!fs::exists(file, unknown)) {
    fs::create_directories(file.parent_path(), unknown);
    if (unknown)
      throw InputError(fmt::format("{}: cannot be made: {}", file.parent_path().string(), unknown.message()));
    try {
      write_new_file_atomically(file, write_json(division_json(division)));
    } catch (const InputError&) {  // another part was faster
    }
  }
  const Division there = read_division(folder);
  if (there.count != division.count)
    throw InputError(
        fmt::format("{}: the run there is divided into {} parts, not {}; give another folder with -o",
                    folder.string(), there.count, division.count));
  if (there.identity != division.identity)
    throw InputError(fmt::format(
        "{}: the parts there are of another experiment ({}{}), or were computed by another build of the program or "
        "of a plugin; give another folder with -o",
        folder.string(), there.experiment,
        there.set.empty() ? "" : fmt::format(", --set {}", fmt::join(there.set, " --set "))));
}

std::vector<fs::path> logs_in(const fs::path& folder, const std::string& name)
{
  std::vector<std::pair<std::size_t, fs::path>> found;
  std::error_code unknown;
  for (fs::directory_iterator at(folder, unknown), end; !unknown && at != end; at.increment(unknown)) {
    const std::string file = at->path().filename().string(), begin = name + "-", rest = ".log";
    if (!file.starts_with(begin) || !file.ends_with(rest) || file.size() <= begin.size() + rest.size())
      continue;
    const std::string number = file.substr(begin.size(), file.size() - begin.size() - rest.size());
    if (const auto n = number_in(number)) found.emplace_back(*n, at->path());
  }
  std::sort(found.begin(), found.end());
  std::vector<fs::path> out;
  for (auto& [number, path] : found) out.push_back(std::move(path));
  return out;
}

fs::path claim_log(const fs::path& folder, const std::string& name)
{
  for (int k = 1;; ++k) {
    fs::path file = folder / fmt::format("{}-{}.log", name, k);
    const int made = ::open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (made < 0 && errno == EEXIST) continue;
    if (made < 0)
      throw ComputationError(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(errno)));
    ::close(made);
    return file;
  }
}

std::string part_list(const std::vector<std::size_t>& numbers)
{
  std::string text;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t last = k;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}{}", text.empty() ? "" : ",", numbers[k],
                        last > k ? fmt::format("-{}", numbers[last]) : "");
    k = last + 1;
  }
  return text;
}

}  // namespace hauberk
