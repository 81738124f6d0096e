#pragma once
/// What a plugin and this program must agree on before anything else of the plugin's table is read.

#include <hauberk/plugin.hpp>

#include <filesystem>
#include <string_view>

namespace hauberk {

/// The handshake this program was built with.
Handshake program_handshake();

/// Compares field by field, in the order of the struct, and stops at the first difference: what comes after
/// it may have another meaning. Throws PluginError that names the file, both sides and the way out; of a
/// library of several plugins also the `number` of the table in its list, from 1 on. Thread safe.
void check_handshake(const Handshake& plugin, const std::filesystem::path& file, int number = 0);

/// Checks what the handshake does not cover: known kind, texts and `fields` set, exactly the factory of the
/// kind set, id equal to the file's name without ending or, in a library of several plugins (`number` as
/// above), one that experiments can name. Throws PluginError. Thread safe.
void check_table(const PluginTable& table, const std::filesystem::path& file, int number = 0);

/// Whether experiments can name a plugin so: letters, digits, '_' and '-', at least one.
bool well_formed_id(std::string_view id);

}  // namespace hauberk
