#pragma once
/// The one entry of a plugin library: a constant table, checked from the top before anything else is used.
///
/// A plugin is a shared library that exports one constant, `hauberk_plugin` (see shapes/torus_union for an
/// example), or a list of several, `hauberk_plugins` (hauberk/kit/plugin_table.hpp). It has no static
/// constructors with effects, and is never unloaded.

#include <hauberk/load_case.hpp>
#include <hauberk/optimizer.hpp>
#include <hauberk/section.hpp>
#include <hauberk/shape.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace hauberk {

/// Raised whenever any type in the interface headers changes.
inline constexpr std::uint32_t interface_revision = 14;

#define HAUBERK_STR2(x) #x
#define HAUBERK_STR(x) HAUBERK_STR2(x)

#if defined(__clang__)
#define HAUBERK_COMPILER "clang " HAUBERK_STR(__clang_major__)
#else
#define HAUBERK_COMPILER "gcc " HAUBERK_STR(__GNUC__)
#endif
// Containers of the debug mode are other types with other layouts; _GLIBCXX_ASSERTIONS changes no layout.
#if defined(_GLIBCXX_DEBUG)
#define HAUBERK_STDLIB_MODE " debug"
#else
#define HAUBERK_STDLIB_MODE ""
#endif
#if defined(_LIBCPP_VERSION)
#define HAUBERK_STDLIB "libc++ " HAUBERK_STR(_LIBCPP_VERSION)
#else
#define HAUBERK_STDLIB "libstdc++ cxx11-abi=" HAUBERK_STR(_GLIBCXX_USE_CXX11_ABI) HAUBERK_STDLIB_MODE
#endif
// Matrices of the other order have the same layout and another meaning.
#if defined(EIGEN_DEFAULT_TO_ROW_MAJOR)
#define HAUBERK_EIGEN_ORDER " row-major"
#else
#define HAUBERK_EIGEN_ORDER ""
#endif
#define HAUBERK_EIGEN              \
  HAUBERK_STR(EIGEN_WORLD_VERSION) \
  "." HAUBERK_STR(EIGEN_MAJOR_VERSION) "." HAUBERK_STR(EIGEN_MINOR_VERSION) HAUBERK_EIGEN_ORDER
#if defined(__has_feature)  // clang's way to ask
#define HAUBERK_HAS_FEATURE(x) __has_feature(x)
#else
#define HAUBERK_HAS_FEATURE(x) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || HAUBERK_HAS_FEATURE(address_sanitizer)
#define HAUBERK_SANITIZERS "address"
#elif defined(__SANITIZE_THREAD__) || HAUBERK_HAS_FEATURE(thread_sanitizer)
#define HAUBERK_SANITIZERS "thread"
#else
#define HAUBERK_SANITIZERS "none"
#endif

/// One number for the sizes and alignments of types: FNV-1a of them, byte by byte.
template <class... Types>
consteval std::uint32_t layout_of()
{
  std::uint32_t hash = 2166136261U;
  for (const std::size_t value : {sizeof(Types)..., alignof(Types)...}) {
    for (int shift = 0; shift < 32; shift += 8)
      hash = (hash ^ (static_cast<std::uint32_t>(value) >> shift & 0xffU)) * 16777619U;
  }
  return hash;
}

/// Of the types that cross the boundary. It differs where a setting that no text of the handshake names
/// (a mode of another standard library, another alignment of numbers) changes a layout.
inline constexpr std::uint32_t interface_layout =
    layout_of<long, double, Sense, std::string, std::vector<double>, std::span<const double>,
              std::shared_ptr<const Solid>, std::unique_ptr<Shape>, std::pair<std::string, double>, Vec3,
              Mat3, Node, Problem, Problems, Field, ParameterInfo, Harmonic, Primitive, MacroInfo,
              PositionMap, LinearInequality, LinearEquality, MacroCondition, SheetState, StricterLoadCase,
              Direction, OptimizationProblem::Evaluation, OptimizerIterate, OptimizerResult,
              OptimizerTraits>();

/// What must agree before the rest of the table is read. Strings are compared by content.
struct Handshake {
  char magic[8];                  ///< "HAUBERK"
  std::uint32_t table_size;       ///< sizeof(PluginTable)
  std::uint32_t revision;         ///< interface_revision
  const char* compiler;           ///< HAUBERK_COMPILER
  const char* standard_library;   ///< HAUBERK_STDLIB
  const char* eigen;              ///< HAUBERK_EIGEN: "3.4.0"
  std::uint32_t eigen_alignment;  ///< EIGEN_MAX_ALIGN_BYTES
  std::uint32_t layout;           ///< interface_layout
  const char* sanitizers;         ///< HAUBERK_SANITIZERS
};

#define HAUBERK_HANDSHAKE                                                               \
  {                                                                                     \
    {'H', 'A', 'U', 'B', 'E', 'R', 'K', '\0'}, sizeof(::hauberk::PluginTable),          \
        ::hauberk::interface_revision, HAUBERK_COMPILER, HAUBERK_STDLIB, HAUBERK_EIGEN, \
        EIGEN_MAX_ALIGN_BYTES, ::hauberk::interface_layout, HAUBERK_SANITIZERS          \
  }

enum class PluginKind : std::uint32_t { shape = 1, load_case = 2, optimizer = 3 };

/// The exported table. Exactly the factory that belongs to `kind` is set.
struct PluginTable {
  Handshake handshake;
  PluginKind kind;
  const char* id;  ///< as written in experiments; of a library of one plugin its file name without ending
  const char* version;
  const char* summary;   ///< one sentence
  const char* citation;  ///< where the method comes from
  /// The plugin's own fields of its section of an experiment.
  void (*fields)(std::vector<Field>& out);
  /// Factories. The section has been checked against `fields`, defaults are filled in; what is wrong beyond
  /// that goes to `problems`, and then null may be returned.
  std::unique_ptr<Shape> (*make_shape)(const Node& section, Problems& problems);
  /// `length` is the scene's characteristic length L in file units; lengths in the section are in file units.
  std::unique_ptr<LoadCase> (*make_load_case)(const Node& section, double length, Problems& problems);
  std::unique_ptr<Optimizer> (*make_optimizer)(const Node& section, Problems& problems);
};

}  // namespace hauberk

/// Marks the exported table: extern "C" HAUBERK_EXPORT const hauberk::PluginTable hauberk_plugin;
#define HAUBERK_EXPORT __attribute__((visibility("default"), used))
