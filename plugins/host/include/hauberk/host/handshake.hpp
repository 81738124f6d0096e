#pragma once
/// What a plugin and this program must agree on before anything else of the plugin's table is read.

#include <hauberk/plugin.hpp>

#include <filesystem>

namespace hauberk {

/// The handshake this program was built with.
Handshake program_handshake();

/// Compares field by field, in the order of the struct, and stops at the first difference: what comes after
/// it may have another meaning. Throws PluginError that names the file, both sides and the way out.
/// Thread safe.
void check_handshake(const Handshake& plugin, const std::filesystem::path& file);

/// Checks what the handshake does not cover: known kind, texts and `fields` set, exactly the factory of the
/// kind set, id equal to the file's name without ending. Throws PluginError. Thread safe.
void check_table(const PluginTable& table, const std::filesystem::path& file);

}  // namespace hauberk
