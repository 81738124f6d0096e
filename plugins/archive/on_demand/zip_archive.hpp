#pragma once
/// The functions of zip_archive.so.

#include "archive/archive.hpp"

namespace hauberk::archives {

/// hauberk_zip_pack: null, or what cannot be done with the archive.
using ZipPack = const char*(const std::vector<std::pair<std::string, std::string>>& files,
                            std::string& bytes);
/// hauberk_zip_unpack.
using ZipUnpack = Unpacked(std::string_view bytes, const std::string& file, std::size_t most,
                           std::string& text);

}  // namespace hauberk::archives
