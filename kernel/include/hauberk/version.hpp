#pragma once
/// Version of this build; generated, do not edit.

namespace hauberk {

inline constexpr const char* version = "0.1.0";
/// Build type and instrumentation, for the provenance of results.
inline constexpr const char* build_type = "RelWithDebInfo";

}  // namespace hauberk
