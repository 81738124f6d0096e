#include "archive/on_demand/zip_archive.hpp"

#include <zip.h>

#include <memory>

namespace hauberk::archives {

extern "C" __attribute__((visibility("default"))) ZipPack hauberk_zip_pack;
extern "C" __attribute__((visibility("default"))) ZipUnpack hauberk_zip_unpack;

/// Times in the archive are constant.
const char* hauberk_zip_pack(const std::vector<std::pair<std::string, std::string>>& files,
                             std::string& bytes)
{
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (target == nullptr) return "made";
  zip_source_keep(target);
  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> kept(target, zip_source_free);
  zip_t* zip = zip_open_from_source(target, ZIP_TRUNCATE, &error);
  if (zip == nullptr) {
    zip_source_free(target);
    return "opened";
  }
  for (const auto& [name, content] : files) {
    zip_source_t* source = zip_source_buffer(zip, content.data(), content.size(), 0);
    const zip_int64_t index =
        source == nullptr ? -1 : zip_file_add(zip, name.c_str(), source, ZIP_FL_ENC_UTF_8);
    constexpr zip_uint16_t day = (40 << 9) | (1 << 5) | 1, hour = 0;  // 2020-01-01, in the format of MS-DOS
    const auto number = static_cast<zip_uint64_t>(index);
    constexpr zip_uint32_t level =
        2;  // of 9: the repetitions of long lists of triangles cost it ten times the time
    if (index < 0 || zip_set_file_compression(zip, number, ZIP_CM_DEFLATE, level) != 0 ||
        zip_file_set_dostime(zip, number, hour, day, 0) != 0) {
      zip_discard(zip);
      return "filled";
    }
  }
  if (zip_close(zip) != 0) return "written";
  zip_stat_t size;
  if (zip_source_open(target) != 0 || zip_source_stat(target, &size) != 0) return "read";
  bytes.assign(size.size, '\0');
  const zip_int64_t read = zip_source_read(target, bytes.data(), bytes.size());
  zip_source_close(target);
  return read == static_cast<zip_int64_t>(bytes.size()) ? nullptr : "read";
}

Unpacked hauberk_zip_unpack(std::string_view bytes, const std::string& file, std::size_t most,
                            std::string& text)
{
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* opened = source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &error);
  if (opened == nullptr) {
    text = zip_error_strerror(&error);
    if (source != nullptr) zip_source_free(source);
    zip_error_fini(&error);
    return Unpacked::no_archive;
  }
  const std::unique_ptr<zip_t, void (*)(zip_t*)> archive(opened, &zip_discard);
  zip_stat_t stat;
  if (zip_stat(opened, file.c_str(), 0, &stat) != 0) return Unpacked::no_such_file;
  if ((stat.valid & ZIP_STAT_SIZE) == 0 || stat.size > most) return Unpacked::too_large;
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> entry(zip_fopen(opened, file.c_str(), 0),
                                                                &zip_fclose);
  if (!entry) {
    text = zip_strerror(opened);
    return Unpacked::not_readable;
  }
  std::string out(stat.size, '\0');
  std::size_t got = 0;
  while (got < out.size()) {
    const zip_int64_t n = zip_fread(entry.get(), out.data() + got, out.size() - got);
    if (n <= 0) return Unpacked::damaged;
    got += static_cast<std::size_t>(n);
  }
  text = std::move(out);
  return Unpacked::done;
}

}  // namespace hauberk::archives
