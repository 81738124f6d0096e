#include "document/atomic_file.hpp"

#include <hauberk/error.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <string>
#include <system_error>
#include <utility>

namespace hauberk {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

/// An open descriptor, closed on every way out.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor()
  {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  /// Closes now, because close itself may report that data did not reach the disk. 0 or errno.
  int close()
  {
    const int fd = std::exchange(fd_, -1);
    return ::close(fd) == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

/// Writes and flushes everything; 0 or errno.
int write_all(int fd, std::string_view content)
{
  while (!content.empty()) {
    const ssize_t n = ::write(fd, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  return ::fsync(fd) == 0 ? 0 : errno;
}

/// Where a file is written before it gets its name; `abandoned` knows such names.
fs::path temporary_for(const fs::path& path)
{
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  return folder / fmt::format(".{}.tmp-{}", path.filename().string(), ::getpid());
}

/// 0 or errno; on errors nothing is left behind.
int write_new(const fs::path& file, std::string_view content)
{
  Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (descriptor.get() < 0) return errno;
  int error = write_all(descriptor.get(), content);
  const int close_error = descriptor.close();
  if (error == 0) error = close_error;
  if (error != 0) ::unlink(file.c_str());
  return error;
}

/// A rename is only durable once its folder is on the disk; some file systems cannot do that: no error.
void flush_folder(const fs::path& folder)
{
  const Descriptor directory(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0) (void)::fsync(directory.get());
}

[[noreturn]] void cannot_write(const fs::path& path, int error)
{
  throw ComputationError(path.string() + ": cannot be written: " + reason(error));
}

/// True for the temporary file of a process that is no more.
bool is_abandoned(const std::string& name, std::span<const char* const> names)
{
  const auto belongs_to_none = [&name](std::size_t digits) {
    pid_t process = 0;
    const char* end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + digits, end, process);
    return error == std::errc() && stop == end && process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
  };
  constexpr std::string_view probe = ".hauberk-write-test.", mark = ".tmp-";
  if (name.starts_with(probe)) return belongs_to_none(probe.size());
  const auto temporary_of = [&](const char* file) {
    const std::string start = std::string(".") + file + std::string(mark);
    return name.starts_with(start) && belongs_to_none(start.size());
  };
  return std::any_of(names.begin(), names.end(), temporary_of);
}

/// Removes those of `names` that are not to stay.
void remove_others(const fs::path& directory, std::span<const char* const> names,
                   const std::vector<std::string>& stay)
{
  std::error_code ignored;
  for (const char* name : names) {
    if (std::find(stay.begin(), stay.end(), name) == stay.end()) fs::remove(directory / name, ignored);
  }
}

/// Not a name that a user would give: what it holds is removed.
fs::path previous_folder(const fs::path& directory) { return directory / ".hauberk-previous"; }

/// A folder itself, not a link to one: what is in that is somebody else's.
bool is_folder(const fs::path& path)
{
  std::error_code unknown;
  return fs::symlink_status(path, unknown).type() == fs::file_type::directory;
}

/// Gives the results in `directory` a second name, which takes no room; they are there under one of the two
/// at any time. The first name is the last one kept: once it is there, all are.
void keep_previous(const fs::path& directory, std::span<const char* const> names)
{
  std::error_code error;
  const fs::path folder = previous_folder(directory);
  if (!is_folder(folder)) fs::remove(folder, error);  // a link makes way
  if (fs::exists(folder / names.front(), error)) return;
  for (std::size_t k = names.size(); k-- > 0;) {
    const char* name = names[k];
    if (!fs::exists(directory / name, error)) continue;
    fs::create_directory(folder, error);
    if (error) cannot_write(folder, error.value());
    fs::remove(folder / name, error);
    fs::create_hard_link(directory / name, folder / name, error);
    if (error) fs::copy_file(directory / name, folder / name, error);
    if (error) {
      const int why = error.value();
      fs::remove(folder / name, error);  // half a copy
      cannot_write(folder / name, why);
    }
  }
}

}  // namespace

void write_files_atomically(const fs::path& directory, const std::vector<NamedContent>& files,
                            std::span<const char* const> names, FormerResults former)
{
  const auto temporary = [&](std::size_t k) { return temporary_for(directory / files[k].name); };
  const auto remove_from = [&](std::size_t first) {
    for (std::size_t k = first; k < files.size(); ++k) ::unlink(temporary(k).c_str());
  };
  std::size_t named = 0;
  try {
    for (std::size_t k = 0; k < files.size(); ++k) {
      if (const int error = write_new(temporary(k), files[k].content); error != 0)
        cannot_write(directory / files[k].name, error);
    }
    if (former == FormerResults::kept) keep_previous(directory, names);
    for (; named < files.size(); ++named) {
      const fs::path path = directory / files[named].name;
      if (::rename(temporary(named).c_str(), path.c_str()) != 0) cannot_write(path, errno);
    }
  } catch (const ComputationError&) {
    remove_from(named);
    throw;
  }
  std::vector<std::string> written;
  written.reserve(files.size());
  for (const NamedContent& file : files) written.push_back(file.name);
  remove_others(directory, names, written);
  flush_folder(directory);
}

void refuse_existing_file(const fs::path& file, const char* way_out)
{
  std::error_code unknown;  // then writing tells
  if (fs::exists(fs::symlink_status(file, unknown)))
    throw InputError(file.string() + ": exists already; " + way_out);
}

void write_new_file_atomically(const fs::path& file, const std::string& content)
{
  const fs::path temporary = temporary_for(file);
  if (const int error = write_new(temporary, content); error != 0) cannot_write(file, error);
  // A second name is refused where the file exists, also when somebody made it just now.
  int error = ::link(temporary.c_str(), file.c_str()) == 0 ? 0 : errno;
  if (error != 0 && error != EEXIST && !fs::exists(file)) {  // a file system without hard links
    error = ::rename(temporary.c_str(), file.c_str()) == 0 ? 0 : errno;
  }
  ::unlink(temporary.c_str());
  if (error == EEXIST) refuse_existing_file(file);
  if (error != 0) cannot_write(file, error);
  flush_folder(file.parent_path());
}

void remove_abandoned(const fs::path& directory, std::span<const char* const> names)
{
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    if (is_abandoned(entry->path().filename().string(), names)) found.push_back(entry->path());
  }
  for (const fs::path& file : found) ::unlink(file.c_str());
}

void prepare_output_directory(const fs::path& directory, bool force, std::span<const char* const> names)
{
  std::error_code error;
  for (const char* name : names) {
    if (!force && fs::exists(directory / name, error))
      throw InputError(fmt::format("{}: holds results already ({}); give another folder with -o, or --force",
                                   directory.string(), name));
  }
  const bool made = fs::create_directories(directory, error);
  if (error)
    throw InputError(directory.string() + ": this output folder cannot be made: " + error.message() +
                     "; give another one with -o");
  remove_abandoned(directory, names);
  const fs::path probe = directory / fmt::format(".hauberk-write-test.{}", ::getpid());
  const int failed = write_new(probe, "");
  ::unlink(probe.c_str());
  if (failed == 0) return;
  if (made) fs::remove(directory, error);
  throw InputError(directory.string() + ": this output folder cannot be written: " + reason(failed) +
                   "; give another one with -o");
}

void drop_previous(const fs::path& directory, std::span<const char* const> names)
{
  if (is_folder(previous_folder(directory))) remove_others(previous_folder(directory), names, {});
  std::error_code ignored;
  fs::remove(previous_folder(directory), ignored);  // unless somebody put more into it
}

}  // namespace hauberk
