#include <hauberk/error.hpp>
#include <hauberk/results/atomic_file.hpp>
#include <hauberk/results/write_results.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
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

/// 0 or errno; on errors nothing is left behind.
int replace_file(const fs::path& path, std::string_view content)
{
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const fs::path temporary = folder / fmt::format(".{}.tmp-{}", path.filename().string(), ::getpid());
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.get() < 0) return errno;
  int error = write_all(file.get(), content);
  const int close_error = file.close();
  if (error == 0) error = close_error;
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    return error;
  }
  // The rename is only durable once its folder is on the disk; some file systems cannot do that: no error.
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() >= 0) (void)::fsync(directory.get());
  return 0;
}

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view content)
{
  if (const int error = replace_file(path, content); error != 0)
    throw ComputationError(path.string() + ": cannot be written: " + reason(error));
}

void prepare_output_directory(const fs::path& directory, bool force)
{
  std::error_code error;
  for (const char* name : {results_file, limits_file, profile_file, designed_file}) {
    if (!force && fs::exists(directory / name, error))
      throw InputError(fmt::format("{}: holds results already ({}); give another folder with -o, or --force",
                                   directory.string(), name));
  }
  fs::create_directories(directory, error);
  if (error) throw InputError(directory.string() + ": this output folder cannot be made: " + error.message());
  const fs::path probe = directory / fmt::format(".hauberk-write-test.{}", ::getpid());
  if (const int failed = replace_file(probe, ""); failed != 0)
    throw InputError(directory.string() + ": this output folder cannot be written: " + reason(failed));
  ::unlink(probe.c_str());
}

}  // namespace hauberk
