#pragma once
/// Libraries of this program that are loaded where they are used.

namespace hauberk {

/// The C function `function` of the library `library`, which lies in the folder hauberk/on_demand beside the
/// kernel's library and stays loaded. What needs other people's libraries and few scenes use is there: the
/// loader takes longer for these libraries than a small scene takes to solve. Throws std::runtime_error, with
/// the file and the loader's words. Thread safe.
void* on_demand(const char* library, const char* function);

}  // namespace hauberk
