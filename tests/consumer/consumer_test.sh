#!/usr/bin/env bash
# As an author outside of this tree: Hauberk installed into a prefix, a project of every kind from the template, built
# against that prefix, checked, and used in its experiment; then the same prefix under another name.
#
#   consumer_test.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail
build=$1 work=$2
rm -rf "$work"
mkdir -p "$work"
fail() { echo "consumer: $*" >&2; exit 1; }
# What a command prints is only of interest when it fails.
quietly() { "$@" >"$work/log.txt" 2>&1 || { cat "$work/log.txt" >&2; fail "failed: $*"; }; }

quietly cmake --install "$build" --prefix "$work/prefix"
prefix=$work/prefix
for page in man/man1/hauberk.1 bash-completion/completions/hauberk zsh/site-functions/_hauberk \
  zsh/vendor-completions/_hauberk fish/vendor_completions.d/hauberk.fish; do
  grep -q 'hauberk' "$prefix/share/$page" || fail "$page is not installed"
done
launcher=()
if command -v ccache >/dev/null; then launcher=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache); fi

project() {  # TEMPLATE NAME
  local folder=$work/$2
  quietly "$prefix/bin/hauberk" plugins new --kind "$1" "$2" "$folder"
  if grep -rnE 'plugin_name|PluginName|plugin_kind|plugin_template' "$folder"; then fail "$2: a mark of the template was left"; fi
  # What compiles twice as fast and runs fast enough.
  quietly cmake -S "$folder" -B "$folder/build" -D CMAKE_PREFIX_PATH="$prefix" -D CMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 \
    "${launcher[@]}"
  if grep -n 'CMake Warning' "$work/log.txt"; then fail "$2: a warning where nothing differs"; fi
  quietly cmake --build "$folder/build"
  # Distances of solids take most of the time of all checks, 9 s; tests/conformance has them of rounded_ring.
  GTEST_FILTER=-Oval.shape_distances quietly ctest --test-dir "$folder/build" --output-on-failure
  grep -q '100% tests passed' "$work/log.txt" || fail "$2: no test ran"
}

check() {  # NAME; its own test has run all checks of the kit
  local folder=$work/$1
  quietly python3 "$(dirname "${BASH_SOURCE[0]}")/../run_paths.py" "$folder/build/plugins/$1.so"
  quietly "$prefix/bin/hauberk" plugins conform "$folder/build/plugins/$1.so" --filter '^(descriptor|fields|instances)$'
  grep -q ' 0 failed' "$work/log.txt" || fail "$1: no summary"
  quietly "$prefix/bin/hauberk" plugins conform "$folder/build/plugins/$1.so" --filter '^descriptor$' --json
  python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["passed"]' "$work/log.txt"
  quietly "$prefix/bin/hauberk" run "$folder/experiment.json" --plugin-path "$folder/build/plugins" -o "$folder/out" \
    --force --quiet
  # The independent check knows the load cases of the program only.
  if [[ $1 != isotropic && $1 != frame ]]; then quietly "$prefix/bin/hauberk" verify "$folder/out/results.json"; fi
}

names=(figure_eight oval isotropic frame spectral)
project shape figure_eight
project solid oval
project load_case isotropic
project patch frame
project optimizer spectral
for name in "${names[@]}"; do check "$name"; done

# Nothing in the prefix knows where it is.
mv "$prefix" "$work/moved"
prefix=$work/moved
quietly cmake -S "$work/figure_eight" -B "$work/again" -D CMAKE_PREFIX_PATH="$prefix" -D BUILD_TESTING=OFF
quietly cmake --build "$work/again"
quietly "$prefix/bin/hauberk" plugins conform "$work/again/plugins/figure_eight.so"

# Installed, a plugin is found without being told where: beside the program's own, or in a folder of the environment.
found() { "$prefix/bin/hauberk" plugins list | grep -q "^$1 " || fail "$1 is not found"; }
quietly cmake --install "$work/again"
quietly cmake --install "$work/frame/build" --prefix "$work/mine"
found figure_eight
HAUBERK_PLUGIN_PATH=$work/mine/lib/hauberk/plugins found frame
quietly "$prefix/bin/hauberk" run "$work/figure_eight/experiment.json" -o "$work/installed" --quiet
rm "$prefix/lib/hauberk/plugins/figure_eight.so"

# Two of them in one library.
mkdir "$work/pair"
table='constinit const hauberk::PluginTable'
for name in figure_eight isotropic; do
  sed "s/^extern \"C\" HAUBERK_EXPORT $table hauberk_plugin/extern const hauberk::PluginTable $name;\n$table $name/" \
    "$work/$name/$name.cpp" >"$work/pair/$name.cpp"
done
cat >"$work/pair/pair.cpp" <<'EOT'
#include <hauberk/kit/plugin_table.hpp>
extern const hauberk::PluginTable figure_eight, isotropic;
HAUBERK_PLUGINS(&figure_eight, &isotropic);
EOT
cat >"$work/pair/CMakeLists.txt" <<'EOT'
cmake_minimum_required(VERSION 3.25)
project(pair LANGUAGES CXX)
find_package(hauberk REQUIRED)
hauberk_add_plugin(pair KIND several SOURCES pair.cpp figure_eight.cpp isotropic.cpp)
EOT
quietly cmake -S "$work/pair" -B "$work/pair/build" -D CMAKE_PREFIX_PATH="$prefix" "${launcher[@]}"
quietly cmake --build "$work/pair/build"
quietly "$prefix/bin/hauberk" plugins conform "$work/pair/build/plugins/pair.so" --filter '^descriptor$'
for name in figure_eight isotropic; do
  quietly "$prefix/bin/hauberk" run "$work/$name/experiment.json" --plugin-path "$work/pair/build/plugins" \
    -o "$work/pair/$name" --quiet
done

# What a plugin would be refused for is told when it is configured.
warns() { grep -qE "^ *$1\$" "$work/log.txt" || { cat "$work/log.txt" >&2; fail "no warning of '$1'"; }; }
quietly cmake -S "$work/figure_eight" -B "$work/again" -D CMAKE_CXX_FLAGS='-D_GLIBCXX_DEBUG -ffast-math'
warns 'standard library: libstdc\+\+ cxx11-abi=1 debug \(Hauberk: libstdc\+\+ cxx11-abi=1\)'
warns 'floating point: inexact \(-ffast-math\) \(Hauberk: exact\)'
if [[ $(uname -m) == x86_64 ]]; then
  quietly cmake -S "$work/figure_eight" -B "$work/again" -D CMAKE_CXX_FLAGS=-mavx
  warns 'Eigen alignment: 32 \(Hauberk: 16\)'
  if grep -q '_GLIBCXX_DEBUG\|fast-math' "$work/log.txt"; then fail "a warning of what does not differ"; fi
fi
other=clang++
if grep -q 'compiler=clang' "$prefix/lib/cmake/hauberk/hauberkConfig.cmake"; then other=g++; fi
if command -v $other >/dev/null; then
  quietly cmake -S "$work/figure_eight" -B "$work/other" -D CMAKE_CXX_COMPILER=$other -D BUILD_TESTING=OFF \
    -D CMAKE_PREFIX_PATH="$prefix"
  warns 'compiler: (clang|gcc) [0-9]+ \(Hauberk: (clang|gcc) [0-9]+\)'
fi
if grep -rl --include='*.cmake' "$work/prefix" "$prefix"; then fail "the package names the folder it was installed to"; fi

# Plugins of this tree that use nothing but what is installed: built outside of it, without those that are installed, and
# used in their examples.
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
outside=$work/outside
mkdir "$outside"
{
  echo 'cmake_minimum_required(VERSION 3.25)'
  echo 'project(outside LANGUAGES CXX)'
  echo 'find_package(hauberk REQUIRED)'
  for plugin in shapes/closed_tube loadcases/volumetric_periodic optimizers/nelder_mead; do
    echo "add_subdirectory(\"$source/$plugin\" \"${plugin#*/}\")"
  done
} >"$outside/CMakeLists.txt"
quietly cmake -S "$outside" -B "$outside/build" -D CMAKE_BUILD_TYPE=Release -D CMAKE_PREFIX_PATH="$prefix" "${launcher[@]}"
quietly cmake --build "$outside/build"
for plugin in shapes/closed_tube loadcases/volumetric_periodic optimizers/nelder_mead; do
  name=${plugin#*/}
  rm "$prefix/lib/hauberk/plugins/$name.so"
  quietly "$prefix/bin/hauberk" plugins conform "$outside/build/plugins/$name.so"
  quietly "$prefix/bin/hauberk" run "$source/$plugin/example.json" --plugin-path "$outside/build/plugins" \
    -o "$outside/$name" --force --quiet
done
echo "consumer: done"
